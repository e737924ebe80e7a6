// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A recording of the embedded face, as a depth camera with a very long lens would make it, and its
// truth.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "hyperex/capture/frame.hpp"
#include "unit/tracking/face_depth.hpp"
#include "unit/tracking/face_pictures.hpp"

namespace hyperex::test {

constexpr int kFaceSize_px = 360;
constexpr double kFaceHeight_m = 0.3, kFaceDistance_m = 8;
constexpr double kFacePxPerM = kFaceSize_px / kFaceHeight_m;
const capture::Intrinsics kFaceCamera{kFacePxPerM * kFaceDistance_m,
                                      kFacePxPerM* kFaceDistance_m,
                                      (kFaceSize_px - 1) / 2.0,
                                      (kFaceSize_px - 1) / 2.0,
                                      kFaceSize_px,
                                      kFaceSize_px};

/// The pose of the head turned to its left by `yaw_rad`, before the middle of the camera.
inline Eigen::Isometry3d face_pose(double yaw_rad) {
  Eigen::Isometry3d camera_from_head = Eigen::Isometry3d::Identity();
  camera_from_head.linear() = (Eigen::AngleAxisd(std::numbers::pi, Vec3::UnitX()) *
                               Eigen::AngleAxisd(yaw_rad, Vec3::UnitY()))
                                  .toRotationMatrix();
  // face_picture() looks at (0, -0.01, 0).
  camera_from_head.translation() =
      Vec3(0, 0, kFaceDistance_m) - camera_from_head.linear() * Vec3(0, -0.01, 0);
  return camera_from_head;
}

inline capture::Frame face_frame(std::size_t index, double yaw_rad) {
  capture::Frame frame;
  frame.index = index;
  frame.time_s = double(index) / 30;
  // Turning the viewer to the head's right shows the head turned to its left.
  frame.colour = tracking::face_picture(kFaceSize_px, kFaceHeight_m, -yaw_rad).bgr;
  const auto& mesh = tracking::face_to_draw().mesh;
  frame.depth_m = tracking::depth_of(
      {tracking::in_camera(face_pose(yaw_rad), mesh.points), mesh.triangles}, kFaceCamera);
  return frame;
}

/// A folder in TUM's layout with truth files: the head turns by 0.02 rad a frame from the third
/// frame on, its face at rest.
inline void write_face_recording(const std::filesystem::path& folder, int frames) {
  constexpr double depth_per_m = 5000;
  std::filesystem::create_directories(folder / "rgb");
  std::filesystem::create_directories(folder / "depth");
  std::ofstream pairs(folder / "associations.txt"), rgb(folder / "rgb.txt"),
      depth(folder / "depth.txt"), camera(folder / "camera.toml"), pose(folder / "truth_pose.csv"),
      weights(folder / "truth_weights.csv"), landmarks(folder / "truth_landmarks68_camera_m.csv");
  camera << fmt::format(
      "width = {0}\nheight = {0}\nfx = {1:.1f}\nfy = {1:.1f}\ncx = {2:.1f}\n"
      "cy = {2:.1f}\ndepth_scale = {3:.1f}\n",
      kFaceSize_px, kFaceCamera.fx_px, kFaceCamera.cx_px, depth_per_m);
  pose << "time_s";
  for (int r = 0; r < 3; ++r)
    for (int c = 0; c < 4; ++c) pose << fmt::format(",T{}{}", r, c);
  landmarks << "time_s";
  for (int i = 0; i < 68; ++i) landmarks << fmt::format(",x{0},y{0},z{0}", i);
  pose << '\n';
  landmarks << '\n';
  weights << "time_s,jawOpen\n";
  for (int k = 0; k < frames; ++k) {
    const double yaw_rad = k < 3 ? 0 : 0.02 * (k - 2);
    const capture::Frame frame = face_frame(std::size_t(k), yaw_rad);
    const std::string time = fmt::format("{:.6f}", frame.time_s);
    cv::Mat stored;
    frame.depth_m.convertTo(stored, CV_16U, depth_per_m);
    cv::imwrite((folder / "rgb" / (time + ".jpg")).string(), frame.colour);
    cv::imwrite((folder / "depth" / (time + ".png")).string(), stored);
    pairs << fmt::format("{0} rgb/{0}.jpg {0} depth/{0}.png\n", time);
    rgb << fmt::format("{0} rgb/{0}.jpg\n", time);
    depth << fmt::format("{0} depth/{0}.png\n", time);
    const Eigen::Isometry3d camera_from_head = face_pose(yaw_rad);
    pose << time;
    for (int r = 0; r < 3; ++r)
      for (int c = 0; c < 4; ++c) pose << fmt::format(",{:.9f}", camera_from_head.matrix()(r, c));
    pose << '\n';
    landmarks << time;
    for (int i = 0; i < 68; ++i) {
      const Vec3 p =
          camera_from_head * tracking::face_to_draw().landmarks.at(fmt::format("ibug68_{}", i));
      landmarks << fmt::format(",{:.6f},{:.6f},{:.6f}", p.x(), p.y(), p.z());
    }
    landmarks << '\n';
    weights << time << ",0\n";
  }
}

}  // namespace hyperex::test
