// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::motion {

/// How the landmarks of a face move in life while the head stands still, as a Gaussian prior
/// (data/landmark_motion.csv, whose head names its sources). n landmarks; metres; +x the subject's
/// left, +y up, +z forward; row 3 i + axis of a matrix belongs to landmark i.
struct LandmarkMotion {
  std::vector<std::string> names;    ///< e.g. "ibug68_36"
  std::vector<std::string> aliases;  ///< another name of the same place, or ""
  std::vector<bool> upper;           ///< brows, eyes, temples and bridge of the nose
  Points rest_m;                     ///< n x 3
  Points sd_m;                       ///< n x 3, standard deviation beyond the modes, > 0
  /// 3 n x modes of brows and eyes, and of the rest of the face, each one standard deviation.
  Eigen::MatrixXd upper_modes_m, lower_modes_m;
};

/// Parsed at the first call, the same object ever after.
const LandmarkMotion& landmark_motion();

/// The covariances (3 m x 3 m, square metres) of the displacements of landmarks `rows` that
/// expressions of the upper and of the lower part of the face make. Within a part, motion beyond
/// the modes is correlated over a distance d as 0.9 exp(-d / 40 mm), so that neighbours that move
/// together are one witness. `turn` carries the table's axes into the wanted ones; `scale` (> 0) is
/// the face's size over that of the table's face.
struct ExpressionPrior {
  Eigen::MatrixXd upper, lower;
};
ExpressionPrior expression_prior(const std::vector<int>& rows, const Eigen::Matrix3d& turn,
                                 double scale);

}  // namespace hyperex::motion
