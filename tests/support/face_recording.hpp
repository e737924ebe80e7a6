// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A recording of the embedded face by a depth camera with a very long focal length, and its true
// values.
#include <filesystem>
#include <numbers>

#include "hyperex/capture/tum_writer.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/tracking/fit/score.hpp"
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

/// The pose of a head rotated to its left by `yaw_rad`, in front of the middle of the camera.
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
  // Rotating the viewer to the head's right shows the head rotated to its left.
  frame.colour = tracking::face_picture(kFaceSize_px, kFaceHeight_m, -yaw_rad).bgr;
  const auto& mesh = tracking::face_to_draw().mesh;
  frame.depth_m = tracking::depth_of(
      {tracking::in_camera(face_pose(yaw_rad), mesh.points), mesh.triangles}, kFaceCamera);
  return frame;
}

/// Writes a folder in TUM's layout with truth files: from the third frame on the head rotates by
/// 0.02 rad per frame, its face at rest.
inline void write_face_recording(const std::filesystem::path& folder, int frames) {
  capture::TumWriter writer(folder, kFaceCamera);
  tracking::Truth truth;
  for (int k = 0; k < frames; ++k) {
    const double yaw_rad = k < 3 ? 0 : 0.02 * (k - 2);
    const capture::Frame frame = face_frame(std::size_t(k), yaw_rad);
    writer.add(frame);
    truth.time_s.push_back(frame.time_s);
    truth.camera_from_face.push_back(face_pose(yaw_rad));
    truth.jaw_open.push_back(0);
    auto& landmarks = truth.landmarks_m.emplace_back();
    for (int i = 0; i < 68; ++i)
      landmarks.row(i) =
          (face_pose(yaw_rad) * tracking::face_to_draw().landmarks.at(face::ibug(i))).transpose();
  }
  writer.finish();
  tracking::write_truth(folder, truth);
}

}  // namespace hyperex::test
