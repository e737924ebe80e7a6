// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::motion {

/// How the landmarks of real faces move while the head stands still, as a Gaussian prior. The file
/// data/landmark_motion.csv names its sources at its top. n landmarks; metres; +x the subject's
/// left, +y up, +z forward; row 3 i + axis of a matrix belongs to landmark i.
struct LandmarkMotion {
  std::vector<std::string> names;    ///< e.g. "ibug68_36"
  std::vector<std::string> aliases;  ///< another name of the same place, or ""
  std::vector<bool> upper;           ///< brows, eyes, temples and bridge of the nose
  Points rest_m;                     ///< n x 3
  Points sd_m;                       ///< n x 3, standard deviation of motion beyond the modes, > 0
  /// Modes of brows and eyes, and of the rest of the face; 3 n rows, one column per mode. Each
  /// column is the displacement at one standard deviation.
  Eigen::MatrixXd upper_modes_m, lower_modes_m;
};

/// Parsed at the first call; later calls return the same object.
const LandmarkMotion& landmark_motion();

/// The covariances (3 m x 3 m, square metres) of the displacements of the landmarks `rows` caused
/// by expressions of the upper and of the lower part of the face. Within a part, the motion that
/// the modes do not describe has a correlation of 0.9 exp(-d / 40 mm) over a distance d; neighbours
/// that move together thus count as one observation. Of the variance of the modes the share 0.3 is
/// common to both sides of the face, and the rest is each side's own. `turn` rotates the table's
/// axes into the wanted axes. `scale` (> 0) is the face's size divided by that of the table's face.
struct ExpressionPrior {
  Eigen::MatrixXd upper, lower;
};
ExpressionPrior expression_prior(const std::vector<int>& rows, const Eigen::Matrix3d& turn,
                                 double scale);

}  // namespace hyperex::motion
