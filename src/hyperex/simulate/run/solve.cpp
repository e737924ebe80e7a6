// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/solve.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace hyperex::simulate {
namespace {

/// An error below this is half of what a run resolves (0.1 mm).
constexpr double kHarmlessError_m = 0.05e-3;

}  // namespace

Solution run_full(fem::Newmark& newmark, const fem::Drive& drive, const std::vector<double>& times,
                  const StepProgress& progress) {
  Solution out;
  out.free_dofs = newmark.free_count();
  const std::vector<int>& prescribed = newmark.prescribed();
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
  for (int step = 1; step <= drive.steps(); ++step) {
    if (wanted < times.size() && times[wanted] <= step) before = newmark.displacement();
    next.d.noalias() = drive.prescribed * drive.s.col(step);
    next.v.noalias() = drive.prescribed * drive.rate.col(step);
    next.a.noalias() = drive.prescribed * drive.second.col(step);
    if (force.size() > 0) force.noalias() = drive.force * drive.s.col(step);
    newmark.step(next, force);
    if (progress) progress(static_cast<double>(step) / drive.steps());
    read_off(step);
  }
  return out;
}

Solution run_reduced(const fem::ReducedModel& model, const fem::Response& response,
                     const std::vector<double>& times) {
  Solution out;
  out.free_dofs = model.free_count();
  out.displacement = response.displacement(times);
  out.basis_size = response.basis_size;
  out.estimated_error = response.estimated_error;
  out.greatest_displacement_m = response.greatest_displacement_m;
  out.converged = response.converged;
  return out;
}

std::optional<Note> note_on_reduced_error(const Solution& solution, double tolerance) {
  if (solution.converged) return {};
  const double error_m = solution.estimated_error * solution.greatest_displacement_m;
  const bool harmless = error_m < kHarmlessError_m;
  std::string text = fmt::format(
      "The reduced model stopped growing at {} vectors. Its estimated error is {:.2g} mm{}: {:.1e} "
      "of the greatest motion, where solver.tolerance asks for {:g}. solver.method = \"direct\" "
      "has no such error and takes longer.",
      solution.basis_size, 1e3 * error_m, harmless ? ", too little to matter" : "",
      solution.estimated_error, tolerance);
  return harmless ? make_note("solver.reduced_error_small", std::move(text), "solver.method")
                  : make_warning("solver.reduced_not_converged", std::move(text), "solver.method");
}

double greatest_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& truth) {
  double apart = 0, most = 0;
  for (Eigen::Index c = 0; c < a.cols(); ++c)
    for (Eigen::Index n = 0; n < a.rows(); n += 3) {
      apart = std::max(apart, (a.col(c) - truth.col(c)).segment<3>(n).norm());
      most = std::max(most, truth.col(c).segment<3>(n).norm());
    }
  return most > 0 ? apart / most : 0;
}

}  // namespace hyperex::simulate
