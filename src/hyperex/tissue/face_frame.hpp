// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::tissue {

/// "ibug68_K".
std::string ibug(int k);
/// The 68 iBUG names.
const std::vector<std::string>& all_ibug();

/// Axes of a face from its landmarks: x to the subject's left (outer eye corner to outer eye
/// corner), y up (chin to nasion, made orthogonal), z forward; the origin midway between the mouth
/// corners. Rigid: lengths stay metres.
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
};
/// Needs ibug68_8, 27, 36, 45, 48, 54 (std::out_of_range otherwise: complete the landmarks first).
FaceFrame face_frame(const io::Landmarks& landmarks);

}  // namespace hyperex::tissue
