// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/estimate/assumptions.hpp"
#include "hyperex/estimate/observation.hpp"
#include "hyperex/estimate/recording_model.hpp"

namespace hyperex::estimate {

/// A mode of the posterior.
struct Mode {
  Eigen::VectorXd x;
  double cost = 0;             ///< minus its logarithm, but for a constant
  Eigen::MatrixXd hessian;     ///< Gauss-Newton, of all unknowns
  std::vector<char> fixed;     ///< per unknown: held, or at a bound
  double weighed_squares = 0;  ///< of the residuals, in units of their errors
  double error_scale = 1;      ///< of the model's errors (1 sigma) over those of Assumptions
  double rms_m = 0;            ///< of observed less modelled coordinates
  int iterations = 0;
};

/// The indices of those that are not fixed.
std::vector<Eigen::Index> free_unknowns(const std::vector<char>& fixed);

/// The posterior of all unknowns given recordings:
///
///   -ln p(x) = 1/2 sum_e r_e^T (N_e + s^2 M_e)^-1 r_e + 1/2 (x - x0)^T P (x - x0)
///
/// r_e: observed less modelled displacement of the points (RecordingModel); N_e = noise^2 I; M_e:
/// Assumptions' errors of the model, M_pq = m_p m_q exp(-|x_p - x_q|^2 / 2 l^2) per axis; s >= 1
/// where the recordings show that they are larger. P: the prior. With the activations a_L, a_R of
/// both sides of a muscle, the mean (a_L + a_R) / 2 has MusclePrior's covariance, and (a_L - a_R)
/// / 2 has
///   e_i e_j side^2 + delta_ij (e_i^2 muscle^2 + least_difference^2),
/// e the mean of the iteration before: a person tries the same on both sides. Activations are >= 0
/// but those of muscles with tone, gains are >= 0.
class Posterior {
 public:
  /// `face` must outlive this.
  Posterior(FaceModel& face, std::vector<Observation> observations, const Assumptions& assumptions);

  /// From `start`; those of `held` (index and value) stay. Gauss-Newton with steps that are halved
  /// until the cost falls. `error_scale`: 0 finds it.
  Mode find(const Eigen::VectorXd& start, const std::vector<std::pair<Eigen::Index, double>>& held,
            double error_scale = 0);
  /// Before anything is seen: no stiffness or gain differs from the scene's, nothing acts.
  Eigen::VectorXd start() const;
  const std::vector<Observation>& observations() const { return observations_; }
  const Unknowns& unknowns() const { return model_.unknowns(); }
  /// The prior's precision about start(), with the efforts of `x`.
  Eigen::MatrixXd prior_precision(const Eigen::VectorXd& x) const;
  /// J^T E^-1 J of all observations at the mode, of all unknowns.
  Eigen::MatrixXd information(const Mode& mode) const;
  /// The same of an observation of this displacement and noise; J is `derivative`.
  Eigen::MatrixXd information(const Eigen::MatrixXd& derivative, const Observation& observation,
                              double error_scale) const;

 private:
  Eigen::LLT<Eigen::MatrixXd> errors(const Observation& observation, double scale) const;
  double cost(const Eigen::VectorXd& x, const Eigen::MatrixXd& precision, double scale);
  double coordinates() const;
  Eigen::VectorXd lower_bounds() const;
  Eigen::VectorXd expand(const Eigen::MatrixXd& precision, Mode& mode);
  Mode minimum(Eigen::VectorXd x, const std::vector<char>& held, double scale, double enough);

  FaceModel& face_;
  std::vector<Observation> observations_;
  RecordingModel model_;
  Assumptions assumptions_;
};

}  // namespace hyperex::estimate
