// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex::render {

/// Orthographic camera: no perspective, so that lengths in the picture's plane can be compared.
struct Camera {
  Vec3 target = Vec3::Zero();      ///< seen in the middle of the picture, m
  Vec3 to_viewer = Vec3::UnitZ();  ///< from the target towards the viewer; any length > 0
  Vec3 up = Vec3::UnitY();         ///< upwards in the picture; not parallel to to_viewer
  double height_m = 0.25;          ///< height of the region that the picture shows

  /// Rows: the directions right, up and towards the viewer (orthonormal), which is the rotation
  /// camera_from_world.
  Eigen::Matrix3d axes() const;
};

/// Pixel position (x right, y down, pixel centres at half integers) and distance towards the viewer
/// from the plane through the target (m).
struct Projected {
  double x = 0, y = 0, towards_viewer_m = 0;
};
Projected project(const Camera& camera, int width_px, int height_px, const Vec3& point);

/// A camera that shows all `points` (finite rows only) in a picture of that aspect (width divided
/// by height), with a share `margin` of the frame left free around them.
Camera framing(const Points& points, const Vec3& to_viewer, double aspect,
               const Vec3& up = Vec3::UnitY(), double margin = 0.06);

/// Views of a face in a frame with +x its left, +y up, +z forward.
Vec3 front_view();
Vec3 three_quarter_view();  ///< 40 degrees to the subject's left, slightly from above

}  // namespace hyperex::render
