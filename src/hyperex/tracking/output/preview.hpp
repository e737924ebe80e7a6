// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "hyperex/capture/frame.hpp"
#include "hyperex/expression/face_model.hpp"
#include "hyperex/render/canvas.hpp"
#include "hyperex/tracking/fit/face_tracker.hpp"

namespace hyperex::tracking {

/// Draws into a recording's pictures what was tracked in them: the mesh as wires where it can be
/// seen, the landmarks, the head's axes (x to the subject's left), and beside the picture the
/// strongest units with bars; below it time, frame and residuals. A frame that is not valid gets a
/// red banner that says why.
class PreviewPainter {
 public:
  /// `model` must outlive the painter.
  PreviewPainter(const expression::FaceModel& model, const capture::Intrinsics& camera);

  /// Size of every picture that is drawn; multiples of 16.
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  /// BGR. `bgr`: the frame's own picture; grey where it is empty or of another size.
  cv::Mat draw(const TrackedFrame& frame, const cv::Mat& bgr);

 private:
  void draw_face(render::Canvas& canvas, const TrackedFrame& frame) const;
  void draw_wires(render::Canvas& canvas, const TriMesh& seen) const;
  void draw_landmarks(render::Canvas& canvas, const TriMesh& seen, const Points& landmarks) const;
  void draw_axes(render::Canvas& canvas, const Eigen::Isometry3d& camera_from_head) const;
  void draw_units(render::Canvas& canvas, const TrackedFrame& frame);
  void draw_status(render::Canvas& canvas, const TrackedFrame& frame) const;
  void draw_banner(render::Canvas& canvas, const std::string& fault) const;
  Eigen::Vector2d place(const Vec3& in_camera) const;

  const expression::FaceModel& model_;
  capture::Intrinsics camera_;
  double scale_;                           // of the drawn picture relative to the recorded one
  int picture_width_, picture_height_;     // as drawn
  int width_px_, height_px_;               // with all that stands beside it
  std::vector<std::array<int, 4>> edges_;  // vertices, then the triangles on both sides (-1: none)
  Eigen::VectorXd strength_;               // of the units, fading: a list that does not flicker
};

}  // namespace hyperex::tracking
