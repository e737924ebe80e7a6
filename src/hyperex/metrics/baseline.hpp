// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics {

/// A baseline for a simulation: the scan, displaced by a method that uses the displacements of some
/// landmarks but no model of the tissue.
struct Baseline {
  std::string name;  ///< "standing still", "warp, 7 points", "warp, all 68", "the same, smoothed",
                     ///< "blend shapes, 7 points", "blend shapes, all 68"
  std::string key;   ///< "standing_still", "warp_7", "warp_68", "warp_68_smoothed", "shapes_7",
                     ///< "shapes_68"
  Points moved;      ///< |rest| x 3, m
};

/// The seven points around mouth and chin: 48, 54, 51, 57, 8, 58, 56.
const std::vector<int>& driven_ibug_points();
/// Points that hold still when a mouth moves: 0-3, 13-16, 17-47.
const std::vector<int>& still_ibug_points();

/// The baselines are a face without motion, radial-basis warps (linear kernel, constant term) and
/// blend shapes. A warp interpolates the displacements of the seven points, with the still points
/// at rest, or those of all 68 points. Blend shapes are fitted to the same points.
/// A landmark's displacement is that of the closest point of the scan at rest, carried by
/// barycentric weights to `truth` (same vertices).
/// The warp by all 68 is also given with a smoothing of 1 mm. Other variants were tried on subject
/// A: constant or affine term, smoothing from 0.3 to 10 mm, displacements at the nearest vertex, by
/// barycentric weights or from the recording. This one has the smallest error with all 68, by about
/// 5 %. With seven points no variant is better than the plain one.
/// The blend shapes are those of real faces (expression/shape_model.hpp), with the most probable
/// weights of 0 or more for the displacements of the seven points or of all 68. The residual at
/// these points and the still ones is interpolated as by the plain warp, so that all are met. The
/// shapes' error at a point is taken as 1.5 mm with seven points and 3 mm with all. Of the values
/// tried, 0.5 to 3 mm, these gave the smallest errors on a real smile. Weights fitted to the still
/// points too gave larger errors.
/// `truth` has |rest| rows or more. Throws InputError naming the landmarks that are missing.
std::vector<Baseline> baselines(const TriMesh& rest, const Points& truth,
                                const io::Landmarks& landmarks);

}  // namespace hyperex::metrics
