// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/simulate/drive/drive.hpp"
#include "hyperex/simulate/load/carried_shapes.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// What a load makes of the outer nodes and of the driven points at the samples of a motion.
struct LoadedSkin {
  Eigen::MatrixXd moved;   ///< 3 |outer nodes| x k, m: by each column of the load
  Eigen::MatrixXd course;  ///< k x samples
  Eigen::MatrixXd points;  ///< 3 |driven points| x samples, m: where they were seen, less rest
};

/// A displacement to add to that of a load, as few directions over time.
struct SkinCorrection {
  std::vector<int> nodes;     ///< outer nodes that it displaces, rising
  Eigen::MatrixXd displaced;  ///< 3 |nodes| x directions
  Eigen::MatrixXd course;     ///< directions x samples, m
};

/// Between the driven points there are two estimates of the skin's displacement. One is the tissue
/// under the fitted muscles. The other is the shapes of real faces whose weights the points say,
/// with the field (DriveField) of what these leave over at the points. Their errors differ: tissue
/// knows the fold and the bones, shapes know where cheeks and lids go. The correction leads from
/// the first towards the second by MuscleOptions::shape_share of the difference, smoothed over the
/// skin, so that what is finer than the shapes (a fold) stays as the tissue makes it:
///   d(x) = cover(x) near(x) share sum_y g(|x - y|) (S w + F (u - S_p w) - u_load)(y),
/// g: a Gaussian of 1 sigma shape_smoothing_m, of sum 1, on the face with the mouth opened; near:
/// from 0 within shape_clear_m of a driven point to 1 at shape_reach_m.
/// `field`: its first points are the driven ones. `prescribed`: unknowns (rising) that stay.
SkinCorrection shape_correction(const tissue::TissueMesh& mesh, const CarriedShapes& shapes,
                                const DriveField& field, const LoadedSkin& load,
                                const std::vector<int>& prescribed, const MuscleOptions& options);

}  // namespace hyperex::simulate
