// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <vector>

#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/drive.hpp"

namespace hyperex::fem {

struct ReducedOptions {
  NewmarkOptions time;
  /// Wanted error over the greatest displacement of any node, all times; rounding of the basis
  /// allows 1e-6.
  double tolerance = 1e-3;
  int most_vectors = 400;  ///< where the tolerance is not reached by then, `converged` is false
  std::function<void()> between_growths = {};  ///< may throw, which ends the run
  double allowed_m = 0;  ///< an error that does no harm, however small the motion is
};

/// The response of a reduced model: d(step) = shapes * course.col(step), all unknowns.
struct Response {
  Eigen::MatrixXd shapes;              ///< 3 |nodes| x (basis + r)
  Eigen::MatrixXd course;              ///< (basis + r) x (steps + 1)
  int basis_size = 0;                  ///< vectors found for the free unknowns
  double estimated_error = 0;          ///< over the greatest displacement
  double greatest_displacement_m = 0;  ///< over the times that were looked at
  bool converged = false;
  int passes = 0;

  /// 3 |nodes| x |times|: displacement at times in steps (3.25: a quarter from step 3 to 4), linear
  /// between steps.
  Eigen::MatrixXd displacement(const std::vector<double>& times_in_steps) const;
};

/// The response to a drive plus `factor` times another, over the same steps of one model. Its error
/// is at most the sum of theirs.
Response sum_of(const Response& a, const Response& b, double factor = 1);

/// K d + C d' + M d'' = f projected onto the motions that its drive makes.
///
/// The basis begins with the static response to each shape of the drive, K_oo^-1 (F - K_oc D). It
/// grows by static solutions for what the reduced motion leaves in the equation of motion at
/// instants spread over the run, which brings in what viscosity and inertia add (for a slow motion
/// these are the next terms of its expansion in powers of time scales, as in second-order Krylov
/// methods: Bai and Su, SIAM J. Matrix Anal. 26, 2005; chosen by the residual as in greedy reduced
/// bases: Haasdonk and Ohlberger, ESAIM M2AN 42, 2008), and is kept orthonormal in the energy
/// (K) product. The error is estimated from how much the last growths moved any node (at those
/// instants and where the change stores most energy): the sum of the changes yet to come were they
/// to go on shrinking as they did; measured never to be exceeded by more than half where viscosity
/// is a tenth of tissue's or more and the steps resolve the motion. It falls short for a run of one
/// single step, and tenfold with much numerical damping (gamma = 0.9) at 1e-5: there, verify
/// against the full model. The better of the last two motions is returned.
///
/// One factorisation of K_oo serves every drive. Numbers do not depend on the number of threads.
class ReducedModel {
 public:
  /// Throws NumericalError where K_oo is not positive definite. `order`: PartitionedFactor.
  ReducedModel(System system, std::vector<int> prescribed,
               std::shared_ptr<const NodeOrder> order = nullptr);
  /// Other values on the same patterns: keeps the ordering.
  void refill(System system);
  /// The system given, to be filled with other values: of no use before refill().
  System release() { return std::move(system_); }

  /// The response from rest (d = d' = 0 on the free unknowns at step 0, d'' in equilibrium).
  Response run(const Drive& drive, const ReducedOptions& options);

  /// The static answer to a drive at times in steps (linear between them), without inertia and
  /// viscosity, all unknowns: 3 |nodes| x |times|. One solution a time, no basis.
  Eigen::MatrixXd at_rest(const Drive& drive, const std::vector<double>& times_in_steps);

  /// The same for forces (3 |nodes| x n, N) where nothing that is prescribed moves.
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
