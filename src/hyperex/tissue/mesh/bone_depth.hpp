// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/anatomy/bones.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

/// A bone deeper than this is not the floor of the layer: in between lie a cavity (mouth, nose,
/// orbit) or further tissue.
inline constexpr double kDeepestBone_m = 0.020;
/// The layer is at least this thick over bone.
inline constexpr double kThinnestOverBone_m = 0.0015;

/// Thickness of the layer under each vertex of `outer`, m. Where a bone lies at most kDeepestBone_m
/// along `inward` (any length), it is the distance to that bone. Where it would grow from one
/// vertex to the next by more than half of their distance, as beside the rim of the orbit, it is
/// reduced. Elsewhere it is `without_bone`, plus the difference from it at the nearest bone, which
/// falls off over some elements.
Eigen::VectorXd bone_depths(const TriMesh& outer, const Points& inward,
                            const Eigen::VectorXd& without_bone, const anatomy::Bones& bones);

}  // namespace hyperex::tissue
