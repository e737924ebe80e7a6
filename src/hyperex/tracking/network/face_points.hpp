// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>

namespace hyperex::tracking {

inline constexpr int face_point_count = 468;
/// One row per vertex of the canonical face (face/canonical_face.hpp): x right, y down in pixels of
/// the picture, pixel centres at integers; z in pixels too, relative to the head, smaller is
/// nearer. Points may lie outside the picture.
using FacePoints = Eigen::Matrix<double, face_point_count, 3, Eigen::RowMajor>;

}  // namespace hyperex::tracking
