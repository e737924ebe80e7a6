// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Internal to this room.
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::tracking {

/// Moves landmarks of the lids from the inner side of a lid to its edge. Scans with open eyes have
/// lids of some thickness, whose inner side leads to the opening; the landmark of an edge may lie
/// there, hidden from the front. From each hidden landmark this goes towards the landmark of the
/// other lid, in the picture from the front, to the last place at which the lid is seen. A landmark
/// that is seen stays, as does one without an edge within 4 mm, or whose other lid is missing.
/// `scan_from_face`: its columns are the face's left, up and front directions. Metres.
void lids_to_edges(io::Landmarks& landmarks, const TriMesh& scan,
                   const Eigen::Matrix3d& scan_from_face);

}  // namespace hyperex::tracking
