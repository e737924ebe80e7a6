// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/tracking/model/face_model.hpp"

namespace hyperex::tracking {

struct UnitReaderOptions {
  double most = 1.5;       ///< weights stay within 0 to this, of units that run both ways +-
  double noise_m = 0.002;  ///< of a vertex
  /// How far the units themselves are wrong: of a vertex's typical displacement by all of them
  /// (root of the sum of squares), and within the lips, which roll in and out.
  double off_units_share = 0.2, off_units_lip_m = 0.004;
  double sparseness = 0.06;  ///< what a unit costs, times the root mean square motion it makes
  double shrinkage = 0.04;   ///< holds units that cannot be told apart together
};

/// How strongly each animation unit acts, read off a tracked face. The weights inside the fit
/// (FaceState) are no such measure: its free displacements take a part of every motion, its prior
/// holds weights near 0, and units whose directions are opposite share a motion, one of them with a
/// negative weight. Here all of the motion is explained by units that push and do not pull:
///
///   min over w, p:  1/2 mean_v |A_v w + J_v p - d_v|^2 / s_v^2
///                 + sparseness sum_k r_k |w_k| + 1/2 sum_k (shrinkage w_k / typical_k)^2
///   with 0 <= w_k <= most; -most <= w_k <= most where negative weights have a name of their own
///   (DeformationUnit::arkit_negative)
///
/// d: vertices less those at rest; A: the units in the person's size; s: the noise and what the
/// units leave out; J p: a small rigid motion, so that an error of the head's pose is no
/// expression; r_k: root mean square of unit k's motion / s, less its rigid part. Convex, one
/// minimum: a frame's weights depend on that frame's vertices alone. Weight 1 is the unit as the
/// model's table has it, in millimetres times the person's size.
class UnitReader {
 public:
  /// `neutral_m`: the person's vertices at rest, |V| x 3; `unit_scale`: the person's size relative
  /// to the model's, > 0.
  UnitReader(const FaceModel& model, const Points& neutral_m, double unit_scale,
             const UnitReaderOptions& options = {});

  /// K weights. `vertices_m`: |V| x 3, head frame, finite.
  Eigen::VectorXd read(const Points& vertices_m) const;

 private:
  Points neutral_m_;
  Eigen::MatrixXd hessian_;   // K x K, of the quadratic part
  Eigen::MatrixXd gradient_;  // K x 3 |V|: times d, what pulls at the weights
  Eigen::VectorXd cost_, least_, most_;
};

}  // namespace hyperex::tracking
