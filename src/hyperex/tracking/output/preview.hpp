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

/// Draws the tracking result into the pictures of a recording: the visible part of the mesh as
/// wires, the landmarks, the axes of the head (x to the subject's left), and beside the face R and
/// L (render::side_marks). Beside the picture, bars show the units with the greatest weights; below
/// it are time, frame and residuals. A frame that is not valid gets a red banner with the reason.
class PreviewPainter {
 public:
  /// `model` must outlive the painter.
  PreviewPainter(const expression::FaceModel& model, const capture::Intrinsics& camera);

  /// Size of every drawn picture, in multiples of 16.
  int width_px() const { return width_px_; }
  int height_px() const { return height_px_; }

  /// Returns a BGR picture. `bgr`: the picture of the frame; if it is empty or of another size,
  /// grey is used.
  cv::Mat draw(const TrackedFrame& frame, const cv::Mat& bgr);

 private:
  void draw_face(render::Canvas& canvas, const TrackedFrame& frame) const;
  void draw_wires(render::Canvas& canvas, const TriMesh& seen) const;
  void draw_landmarks(render::Canvas& canvas, const TriMesh& seen, const Points& landmarks) const;
  void draw_axes(render::Canvas& canvas, const Eigen::Isometry3d& camera_from_head) const;
  void draw_sides(render::Canvas& canvas, const TriMesh& seen,
                  const Eigen::Isometry3d& camera_from_head) const;
  void draw_units(render::Canvas& canvas, const TrackedFrame& frame);
  void draw_status(render::Canvas& canvas, const TrackedFrame& frame) const;
  void draw_banner(render::Canvas& canvas, const std::string& fault) const;
  Eigen::Vector2d place(const Vec3& in_camera) const;

  const expression::FaceModel& model_;
  capture::Intrinsics camera_;
  double scale_;                           // size of the drawn picture relative to the recorded one
  int picture_width_, picture_height_;     // size of the recorded picture as drawn
  int width_px_, height_px_;               // size including the panels
  std::vector<std::array<int, 4>> edges_;  // vertices, then the triangles on both sides (-1: none)
  // Decaying maximum of each unit's weight, which keeps the list from flickering.
  Eigen::VectorXd strength_;
};

}  // namespace hyperex::tracking
