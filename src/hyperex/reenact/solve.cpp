// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/solve.hpp"

#include <cmath>

#include "hyperex/core/progress.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/fem/time/newmark.hpp"

namespace hyperex::reenact {
namespace {

Solution solve_full(fem::System system, const std::vector<int>& prescribed, const fem::Drive& drive,
                    const std::vector<double>& times, const fem::NewmarkOptions& options,
                    fem::LinearSolver linear) {
  Solution out;
  fem::Newmark newmark(std::move(system), prescribed, options, linear);
  out.linear_solver = newmark.solver();
  out.free_dofs = newmark.free_count();
  out.analyse_s = newmark.analyse_seconds();
  out.factor_s = newmark.factor_seconds();

  Stopwatch watch;
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(newmark.displacement().size());
  fem::Kinematics next = drive.prescribed_at(0);
  Eigen::VectorXd force = drive.force_at(0);
  Eigen::VectorXd d = zero, v = zero;
  d(prescribed) = next.d;
  v(prescribed) = next.v;
  newmark.start(d, v, next.a, force);
  out.displacement.resize(zero.size(), static_cast<Eigen::Index>(times.size()));
  std::size_t wanted = 0;
  Eigen::VectorXd before = d;
  const auto read_off = [&](int step) {
    for (; wanted < times.size() && times[wanted] <= step + 1e-9; ++wanted) {
      const double share = step - times[wanted];
      out.displacement.col(static_cast<Eigen::Index>(wanted)) =
          share * before + (1 - share) * newmark.displacement();
    }
  };
  read_off(0);
  Progress progress("simulating", drive.steps());
  for (int step = 1; step <= drive.steps(); ++step) {
    if (wanted < times.size() && times[wanted] <= step) before = newmark.displacement();
    next.d.noalias() = drive.prescribed * drive.s.col(step);
    next.v.noalias() = drive.prescribed * drive.rate.col(step);
    next.a.noalias() = drive.prescribed * drive.second.col(step);
    if (force.size() > 0) force.noalias() = drive.force * drive.s.col(step);
    newmark.step(next, force);
    progress.update(step);
    read_off(step);
  }
  out.step_s = watch.lap();
  return out;
}

Solution solve_reduced(fem::System system, const std::vector<int>& prescribed,
                       const fem::Drive& drive, const std::vector<double>& times,
                       const fem::ReducedOptions& options, fem::LinearSolver linear) {
  Solution out;
  fem::ReducedModel model(std::move(system), prescribed, linear);
  out.linear_solver = model.solver();
  out.free_dofs = model.free_count();
  out.analyse_s = model.analyse_seconds();
  out.factor_s = model.factor_seconds();
  Stopwatch watch;
  const fem::Response response = model.run(drive, options);
  out.basis_s = watch.lap();
  out.displacement = response.displacement(times);
  out.step_s = watch.lap();
  out.basis_size = response.basis_size;
  out.estimated_error = response.estimated_error;
  out.converged = response.converged;
  return out;
}

/// Greatest distance of any node between the two, over the greatest displacement of any.
double difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& truth) {
  double apart = 0, most = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c)
    for (Eigen::Index n = 0; n < a.rows(); n += 3) {
      apart = std::max(apart, (a.col(c) - truth.col(c)).segment<3>(n).norm());
      most = std::max(most, truth.col(c).segment<3>(n).norm());
    }
  return most > 0 ? apart / most : 0;
}

}  // namespace

Solution solve(fem::System system, const std::vector<int>& prescribed, const fem::Drive& drive,
               const std::vector<double>& times, const SolverOptions& options, double dt_s) {
  const fem::NewmarkOptions time{dt_s, options.newmark_beta, options.newmark_gamma};
  if (options.method == SolverMethod::direct)
    return solve_full(std::move(system), prescribed, drive, times, time, options.linear);
  const fem::ReducedOptions reduced{time, options.tolerance};
  if (!options.verify)
    return solve_reduced(std::move(system), prescribed, drive, times, reduced, options.linear);
  Solution out = solve_reduced(system, prescribed, drive, times, reduced, options.linear);
  const Solution full =
      solve_full(std::move(system), prescribed, drive, times, time, options.linear);
  out.verified_error = difference(out.displacement, full.displacement);
  return out;
}

}  // namespace hyperex::reenact
