// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/drive.hpp"

namespace hyperex::fem {

struct ReducedOptions {
  NewmarkOptions time;
  /// Required error, as a share of the greatest displacement of any node at any time. Rounding of
  /// the basis allows about 1e-6.
  double tolerance = 1e-3;
  int most_vectors = 400;  ///< if the tolerance is not reached with these, `converged` is false
  std::function<void()> between_growths = {};  ///< may throw, which cancels the run
  double allowed_m = 0;                        ///< an absolute error (m) that is always acceptable
};

/// The response of a reduced model: d(step) = shapes * course.col(step), all unknowns.
struct Response {
  Eigen::MatrixXd shapes;              ///< 3 |nodes| x (basis + r)
  Eigen::MatrixXd course;              ///< (basis + r) x (steps + 1)
  int basis_size = 0;                  ///< vectors found for the free unknowns
  double estimated_error = 0;          ///< as a share of the greatest displacement
  double greatest_displacement_m = 0;  ///< over the sampled instants
  bool converged = false;
  int passes = 0;

  /// Displacement at the given times, 3 |nodes| x |times|. Times are in steps: 3.25 is a quarter of
  /// the way from step 3 to step 4. Linear between steps.
  Eigen::MatrixXd displacement(const std::vector<double>& times_in_steps) const;
};

/// The response to the sum of two drives, the second multiplied by `factor`. Both must have the
/// same steps and model. The error is at most the sum of the two errors.
Response sum_of(const Response& a, const Response& b, double factor = 1);

/// The equation of motion K d + C d' + M d'' = f, projected onto a basis that is built for its
/// drive.
///
/// The basis begins with the static response to each shape of the drive, K_oo^-1 (F - K_oc D). It
/// grows by static solutions for the residual of the equation of motion at instants spread over the
/// run. They supply the effects of viscosity and inertia. For a slow motion they are the next terms
/// of its expansion in powers of the time scales, as in second-order Krylov methods (Bai and Su,
/// SIAM J. Matrix Anal. 26, 2005). The choice by residual is that of greedy reduced bases (Haasdonk
/// and Ohlberger, ESAIM M2AN 42, 2008). The basis is kept orthonormal in the energy (K) inner
/// product.
///
/// The error is estimated from how much the last growths changed the motion of any node, at those
/// instants and where the change stores most energy. The estimate is the sum of all further changes
/// if they continue to decrease at the same rate. In tests, the true error never exceeded the
/// estimate by more than half if the viscosity is at least a tenth of that of tissue and the steps
/// resolve the motion. The estimate is too small for a run of a single step. It is too small by a
/// factor of ten at a tolerance of 1e-5 with strong numerical damping (gamma = 0.9). Verify such
/// cases with the full model. The better of the last two motions is returned.
///
/// One factorisation of K_oo serves every drive. The results do not depend on the number of
/// threads.
class ReducedModel {
 public:
  /// Throws NumericalError if K_oo is not positive definite. `order`: see PartitionedFactor.
  ReducedModel(System system, std::vector<int> prescribed,
               std::shared_ptr<const NodeOrder> order = nullptr);
  /// Replaces the values of the matrices; their patterns and the ordering are kept.
  void refill(System system);
  /// Returns the system, so that it can be filled with other values. The model cannot be used again
  /// until refill().
  System release() { return std::move(system_); }

  /// The response from rest (d = d' = 0 on the free unknowns at step 0, d'' in equilibrium).
  Response run(const Drive& drive, const ReducedOptions& options);

  /// The static response to a drive without inertia and viscosity, all unknowns: 3 |nodes| x
  /// |times|. Times are in steps (linear between them). Takes one solution per time and uses no
  /// basis.
  Eigen::MatrixXd at_rest(const Drive& drive, const std::vector<double>& times_in_steps);

  /// The same for forces (3 |nodes| x n, N) with zero prescribed displacements.
  Eigen::MatrixXd at_rest(const Eigen::MatrixXd& force);

  int free_count() const { return static_cast<int>(factor_.free().size()); }
  double analyse_seconds() const { return factor_.analyse_seconds(); }
  double factor_seconds() const { return factor_.factor_seconds(); }
  double factor_entries() const { return factor_.factor_entries(); }
  const std::shared_ptr<const NodeOrder>& order() const { return factor_.order(); }

 private:
  System system_;
  PartitionedFactor factor_;
};

}  // namespace hyperex::fem
