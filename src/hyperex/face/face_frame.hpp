// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// Axes of a face from its landmarks: x to the subject's left, y up, z forward. Rigid: lengths stay
/// metres.
struct FaceFrame {
  Vec3 origin, x, y, z;
  Vec3 local(const Vec3& p) const {
    const Vec3 q = p - origin;
    return {q.dot(x), q.dot(y), q.dot(z)};
  }
  Points local_points(const Points& points) const {
    Points out(points.rows(), 3);
    for (Eigen::Index v = 0; v < points.rows(); ++v) out.row(v) = local(points.row(v)).transpose();
    return out;
  }
  Vec3 world(const Vec3& q) const { return origin + q.x() * x + q.y() * y + q.z() * z; }
  /// The rotation face_from_scan: its rows are the axes.
  Eigen::Matrix3d face_from_scan() const {
    Eigen::Matrix3d rows;
    rows << x.transpose(), y.transpose(), z.transpose();
    return rows;
  }
};

/// The frame of a face with all its landmarks: x from outer eye corner to outer eye corner, y from
/// chin to nasion, made orthogonal; the origin midway between the mouth corners. Needs ibug68_8,
/// 27, 36, 45, 48, 54 (std::out_of_range otherwise: complete the landmarks first).
FaceFrame face_frame(const io::Landmarks& landmarks);

/// The frame of a face with the few landmarks that a user set, where chin and nasion are often
/// absent: y from the mouth to the outer eye corners, which leans back by some degrees against that
/// of face_frame; the rest as there. Needs the outer corners of the eyes and those of the mouth,
/// under their anatomical or their iBUG names (the former count where both are given); nullopt
/// where one is absent or they lie on one line.
std::optional<FaceFrame> face_frame_of_corners(const io::Landmarks& landmarks);

}  // namespace hyperex::face
