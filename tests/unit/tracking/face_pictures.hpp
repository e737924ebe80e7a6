// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Pictures of the embedded face, with the true positions of its landmarks.
#include <map>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/tracking/network/landmark_tracker.hpp"

namespace hyperex::tracking {

struct FacePicture {
  cv::Mat bgr;
  std::map<std::string, cv::Point2d> landmarks;  // pixels, centres at integers
};

inline const anatomy::EmbeddedFace& face_to_draw() {
  static const anatomy::EmbeddedFace face = anatomy::embedded_face();
  return face;
}

/// The face rotated by `yaw_rad` and tilted by `roll_rad`, in a square of `size_px` that is
/// `height_m` high.
inline FacePicture face_picture(int size_px, double height_m, double yaw_rad = 0,
                                double roll_rad = 0) {
  const auto& face = face_to_draw();
  const render::Camera camera{.target = {0, -0.01, 0},
                              .to_viewer = {std::sin(yaw_rad), 0, std::cos(yaw_rad)},
                              .up = {std::sin(roll_rad), std::cos(roll_rad), 0},
                              .height_m = height_m};
  render::Image image = render::render(
      {{.mesh = face.mesh}}, camera,
      {.width_px = size_px, .height_px = size_px, .samples = 2, .background = {0.45, 0.47, 0.5}});
  FacePicture picture;
  cv::cvtColor(cv::Mat(size_px, size_px, CV_8UC3, image.rgb.data()), picture.bgr,
               cv::COLOR_RGB2BGR);
  for (const auto& [name, at] : face.landmarks) {
    const auto p = render::project(camera, size_px, size_px, at);
    picture.landmarks[name] = {p.x - 0.5, p.y - 0.5};
  }
  return picture;
}

/// Errors of the 51 inner iBUG points, pixels, sorted.
inline std::vector<double> errors_px(const FacePoints& points, const FacePicture& picture) {
  std::vector<double> errors;
  for (int k = 17; k < 68; ++k) {
    const std::string name = "ibug68_" + std::to_string(k);
    const Vec3 p = face::canonical_face().landmark(name, points);
    errors.push_back(cv::norm(cv::Point2d(p.x(), p.y()) - picture.landmarks.at(name)));
  }
  std::sort(errors.begin(), errors.end());
  return errors;
}

}  // namespace hyperex::tracking
