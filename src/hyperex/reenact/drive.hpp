// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"

namespace hyperex::reenact {

struct DrivenPoint {
  std::string name;
  Vec3 rest;  ///< scan frame, m
};

/// Skin nodes that take prescribed displacements: a patch around each driven point, reaching
/// `patch_radius_m`, but no farther than the next driven point of the same lip, and never across
/// the slit. In a patch the displacement is the radial-basis interpolation of the driven points of
/// that side, so that it meets every driven point and varies smoothly between them. Linear in the
/// points' displacements:
///   u(node j) = sum_i weight(j, i) d_i.
struct DrivenPatches {
  std::vector<int> nodes;   ///< outer nodes, rising
  Eigen::MatrixXd weights;  ///< |nodes| x |points|
};

/// Throws InputError ("source: ...") where a point lies farther than 25 mm from the skin.
DrivenPatches driven_patches(const std::vector<DrivenPoint>& points, const tissue::TissueMesh& mesh,
                             double patch_radius_m, const std::string& source);

}  // namespace hyperex::reenact
