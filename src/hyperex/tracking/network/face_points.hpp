// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

namespace hyperex::tracking {

inline constexpr int face_point_count = 468;
/// One row per vertex of the canonical face (face/canonical_face.hpp). x to the right and y down
/// are in pixels of the picture, with pixel centres at integers. z is also in pixels, relative to
/// the head; smaller is nearer. Points may lie outside the picture.
using FacePoints = Eigen::Matrix<double, face_point_count, 3, Eigen::RowMajor>;

}  // namespace hyperex::tracking
