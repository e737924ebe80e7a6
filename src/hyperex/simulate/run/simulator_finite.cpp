// SPDX-License-Identifier: GPL-3.0-or-later
// A run at finite strain.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

std::vector<double> Simulator::Impl::finite_times_s() const {
  const double interval_s = options.solver.finite_step_s > 0 ? options.solver.finite_step_s
                                                             : 1 / options.time.frame_rate_hz;
  const double end = end_s();
  const int count = std::max(1, static_cast<int>(std::ceil(end / interval_s - 1e-9)));
  std::vector<double> out;
  for (int k = 0; k <= count; ++k) out.push_back(std::min(k * interval_s, end));
  return out;
}

NodalCourse Simulator::Impl::patch_places(const std::vector<double>& times_s) {
  ensure_factor();
  std::vector<double> times;
  for (const double t : times_s)
    times.push_back(std::min(t / options.time.step_s, double(steps())));
  const Eigen::MatrixXd nodes =
      stages.factor->model
          .run(drive_by(stages.load.value(), as_recorded(options.muscles)),
               {newmark(), options.solver.tolerance})
          .displacement(times);
  NodalCourse out;
  out.nodes = stages.load->patch_nodes;
  Eigen::VectorXd at(3 * Eigen::Index(out.nodes.size()));
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    for (std::size_t i = 0; i < out.nodes.size(); ++i)
      at.segment<3>(3 * Eigen::Index(i)) = nodes.col(Eigen::Index(k)).segment<3>(3 * out.nodes[i]);
    out.take(times_s[k], at);
  }
  return out;
}

FiniteDrive Simulator::Impl::finite_drive(const MuscleOptions& muscles,
                                          const NodalCourse* places) const {
  FiniteDrive drive;
  drive.step_s = options.time.step_s;
  drive.places = places;
  if (!by_forces()) {
    drive.still = stages.input->drive;
    return drive;
  }
  if (changes_rest() && !places) {
    drive.rest_prescribed = stages.moved_bones->prescribed;
    drive.rest_force = stages.moved_bones->force;
  }
  const HeldLoad load = places ? stages.load.value() : on_moved_bones(stages.load.value());
  std::vector<char> turning = turning_columns(load, muscles.table());
  drive.turning = drive_by(with_columns(load, turning), muscles);
  for (char& turns : turning) turns = !turns;
  drive.still = drive_by(with_columns(load, turning), muscles);
  if (!places) drive.forces = patch_forces_with(load, muscles);
  return drive;
}

FiniteSolution Simulator::Impl::run_at_finite_strain(const MuscleOptions& muscles,
                                                     bool hold_patches,
                                                     const std::vector<double>& times) {
  Stopwatch watch;
  const fem::Assembler& assembler = stages.pattern.value();
  const Boundary& boundary = stages.boundary.value();
  const std::vector<double> times_s = finite_times_s();
  NodalCourse places;
  if (hold_patches) places = patch_places(times_s);
  FiniteDrive drive = finite_drive(muscles, hold_patches ? &places : nullptr);
  // The motion as recorded was that of the face before anything was added.
  const bool grows = !hold_patches && !options.tissue.volume_ratio.empty();
  if (grows) drive.rest_guess = neutral_at_small_strain();
  fem::FiniteStrain form(grows ? grown_pattern() : assembler, material(), options.model.law);
  fem::SparseMatrix springs = assembler.stiffness_pattern();
  boundary.add_springs(springs);
  springs.prune(0.0);
  report.assemble_s += watch.lap();
  fem::FiniteNewtonOptions how;
  how.tolerance = options.solver.finite_tolerance;
  how.full_newton = options.solver.full_newton;
  std::vector<int> prescribed = boundary.prescribed();
  if (hold_patches) prescribed = with_nodes(prescribed, places.nodes);
  auto order_now = known_order();
  if (hold_patches && order_now)
    order_now = std::make_shared<const fem::NodeOrder>(
        restricted(*order_now, int(springs.cols()), boundary.prescribed(), prescribed));
  fem::FiniteNewton newton(form, std::move(prescribed), how, std::move(springs), {}, order_now);
  if (!hold_patches) keep_order(newton.order());
  report.factor_s += watch.lap();
  FiniteSolution out = run_finite(newton, assembler, boundary.prescribed(), drive, times_s, times,
                                  [this](double share) { progress.report(kDirectDone * share); });
  report.steps += out.parts;
  report.iterations += out.iterations;
  report.factorisations += out.factorisations;
  return out;
}

Solution Simulator::Impl::solve_finite(const std::vector<double>& times) {
  const bool held = stages.load.held() && stages.load.has_value() && stages.load->patch_forces;
  if (held && stages.load->patch_forces->time_s.back() < end_s() - 1e-9)
    throw InputError(
        "time.end_s",
        fmt::format("{:g} s: the held forces are those of a run of {:g} s; expected no more",
                    end_s(), stages.load->patch_forces->time_s.back()));
  if (!by_forces() || held)
    return std::move(run_at_finite_strain(options.muscles, false, times).solution);
  // The forces that hold the patches are found by the motion as recorded, whatever the gains.
  FiniteSolution recorded = run_at_finite_strain(as_recorded(options.muscles), true, times);
  HeldLoad whole = stages.load.value();
  whole.patch_forces = std::make_shared<const NodalCourse>(std::move(recorded.reactions));
  stages.load.complete(std::make_shared<const HeldLoad>(std::move(whole)));
  if (options.muscles == as_recorded(options.muscles) && !changes_rest())
    return std::move(recorded.solution);
  return std::move(run_at_finite_strain(options.muscles, false, times).solution);
}

}  // namespace hyperex::simulate
