// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/simulate/drive/drive.hpp"
#include "hyperex/simulate/load/carried_shapes.hpp"
#include "hyperex/simulate/options.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// The effect of a load on the outer nodes, and the observed driven points, at the samples of a
/// motion.
struct LoadedSkin {
  Eigen::MatrixXd moved;   ///< 3 |outer nodes| x k, m: by each column of the load
  Eigen::MatrixXd course;  ///< k x samples
  Eigen::MatrixXd points;  ///< 3 |driven points| x samples, m: observed displacement
};

/// A displacement that is added to that of a load, as a few directions with time courses.
struct SkinCorrection {
  std::vector<int> nodes;     ///< outer nodes that it displaces, rising
  Eigen::MatrixXd displaced;  ///< 3 |nodes| x directions
  Eigen::MatrixXd course;     ///< directions x samples, m
};

/// Between the driven points there are two estimates of the skin's displacement. The first is the
/// displacement of the tissue under the fitted muscles. The second is the sum of the shapes of real
/// faces, with the weights fitted to the points, and of their residual at the points, interpolated
/// by a DriveField. The errors of the two differ: the first contains folds and the effect of bones,
/// the second the motion of cheeks and lids. The correction is MuscleOptions::shape_share of their
/// difference, smoothed over the skin. Details finer than the smoothing, such as a fold, therefore
/// remain those of the first estimate:
///   d(x) = cover(x) near(x) share sum_y g(|x - y|) (S w + F (u - S_p w) - u_load)(y),
/// g: a Gaussian of 1 sigma shape_smoothing_m, of sum 1, on the face with the mouth opened; near:
/// from 0 within shape_clear_m of a driven point to 1 at shape_reach_m.
/// `field`: its first points are the driven ones. `prescribed`: unknowns (rising) that stay.
SkinCorrection shape_correction(const tissue::TissueMesh& mesh, const CarriedShapes& shapes,
                                const DriveField& field, const LoadedSkin& load,
                                const std::vector<int>& prescribed, const MuscleOptions& options);

}  // namespace hyperex::simulate
