// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::face {

/// An orthonormal frame of a face, derived from its landmarks: x to the subject's left, y up, z
/// forward. Lengths are in metres and are not scaled.
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

/// The frame of a face with all its landmarks. x points from the right outer eye corner to the left
/// one; y points from chin to nasion and is made orthogonal to x. The origin is midway between the
/// mouth corners. Needs ibug68_8, 27, 36, 45, 48, 54 (otherwise std::out_of_range: complete the
/// landmarks first).
FaceFrame face_frame(const io::Landmarks& landmarks);

/// The frame of a face with few landmarks given by the user, where chin and nasion are often
/// absent. y points from the mouth to the outer eye corners, and so is inclined backwards by some
/// degrees relative to y of face_frame; the rest is the same. Needs the outer corners of the eyes
/// and the corners of the mouth, under their anatomical or iBUG names. If both names are given, the
/// anatomical one is used. Returns nullopt if a point is absent or if they lie on one line.
std::optional<FaceFrame> face_frame_of_corners(const io::Landmarks& landmarks);

}  // namespace hyperex::face
