// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// What a simulation is measured against: the scan carried by a warp that knows where some
/// landmarks went, and nothing of tissue.
struct Baseline {
  std::string name;  ///< "standing still", "warp, 7 points", "warp, all 68", "the same, smoothed"
  std::string key;   ///< "standing_still", "warp_7", "warp_68", "warp_68_smoothed"
  Points moved;      ///< |rest| x 3, m
};

/// The seven points around mouth and chin: 48, 54, 51, 57, 8, 58, 56.
const std::vector<int>& driven_ibug_points();
/// Points that hold still when a mouth moves: 0-3, 13-16, 17-47.
const std::vector<int>& still_ibug_points();

/// Standing still, and the radial-basis warps (linear kernel, constant term, no smoothing) with the
/// displacement of the seven points beside the still points, and of all 68, the latter also with a
/// smoothing of 1 mm: of the variants tried on subject A (constant or affine term, smoothing from
/// 0.3 to 10 mm, displacements at the nearest vertex, by barycentric weights or from the recording)
/// it scores lowest with all 68, by about 5 %; with seven none beats the plain one. A landmark's
/// displacement is that of the closest point of the scan at rest, carried by barycentric weights
/// to `truth` (same vertices); still points of the first warp stand still.
/// `truth` has |rest| rows or more. Throws InputError naming the landmarks that are missing.
std::vector<Baseline> baselines(const TriMesh& rest, const Points& truth,
                                const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
