// SPDX-License-Identifier: GPL-3.0-or-later
// A run: from the stages to the motion of the tissue.
#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hyperex/core/stopwatch.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

namespace {

/// Frames and stills in the order of their times.
std::vector<FrameTime> frame_times_of(const TimeOptions& time, double end_s,
                                      std::vector<double>& frame_time_s) {
  std::vector<FrameTime> out;
  const int frames = frame_count(time, end_s);
  for (int f = 0; f < frames; ++f) {
    frame_time_s.push_back(f / time.frame_rate_hz);
    out.push_back({std::min(frame_time_s.back(), end_s), f});
  }
  for (std::size_t i = 0; i < time.still_times_s.size(); ++i)
    out.push_back({std::min(time.still_times_s[i], end_s), -1 - static_cast<int>(i)});
  std::stable_sort(out.begin(), out.end(),
                   [](const FrameTime& a, const FrameTime& b) { return a.time_s < b.time_s; });
  return out;
}

}  // namespace

std::optional<fem::Response> Simulator::Impl::response_by_gains(const fem::ReducedOptions& how) {
  if (!by_forces() || stages.load->muscles.names.empty() || options.muscles.mirrored) return {};
  const std::vector<std::string>& names = stages.load->muscles.names;
  const Eigen::VectorXd change =
      muscle_gains(names, options.muscles.gains, options.muscles.table()).array() - 1;
  Eigen::Index most = 0;
  if (change.cwiseAbs().maxCoeff(&most) == 0) return {};
  const MuscleOptions as_was = as_recorded(options.muscles);
  stages.recorded.ensure([&] {
    return stages.factor->model.run(drive_by(on_moved_bones(stages.load.value()), as_was), how);
  });
  // Different strengths of the same muscles add multiples of the same motion.
  const Eigen::VectorXd direction = change / change[most];
  stages.direction.set({direction.begin(), direction.end()});
  stages.added_drive.ensure(
      [&] { return drive_by(added_by_gains(stages.load.value(), direction), as_was); });
  if (2 * stages.added_drive->shapes() > stages.input->drive.shapes()) return {};
  stages.added.ensure([&] {
    fem::ReducedOptions less = how;  // half of the whole's error is enough
    less.allowed_m = 0.5 * how.tolerance * stages.recorded->greatest_displacement_m;
    return stages.factor->model.run(stages.added_drive.value(), less);
  });
  fem::Response sum = fem::sum_of(stages.recorded.value(), stages.added.value(), change[most]);
  if (!sum.converged || sum.estimated_error > how.tolerance) return {};
  return sum;
}

void Simulator::Impl::ensure_response(const fem::ReducedOptions& how) {
  stages.response.ensure([&] {
    std::optional<fem::Response> by_gains = response_by_gains(how);
    return by_gains ? std::move(*by_gains) : stages.factor->model.run(stages.input->drive, how);
  });
}

Solution Simulator::Impl::solve_linear(const std::vector<double>& times) {
  const auto progress_of_steps = [this](double share) { progress.report(kDirectDone * share); };
  if (options.solver.method == SolverMethod::direct) {
    ensure_full_model();
    return run_full(stages.full.value(), stages.input->drive, times, progress_of_steps);
  }
  ensure_factor();
  progress.throw_if_cancelled();
  Stopwatch watch;
  fem::ReducedOptions how{newmark(), options.solver.tolerance};
  how.between_growths = [this] { progress.report_towards(kReducedDone); };
  ensure_response(how);
  report.basis_s = watch.lap();
  Solution out = run_reduced(stages.factor->model, stages.response.value(), times);
  if (!options.solver.verify) return out;
  ensure_full_model();
  const Solution full =
      run_full(stages.full.value(), stages.input->drive, times, progress_of_steps);
  out.verified_error = greatest_difference(out.displacement, full.displacement);
  return out;
}

void Simulator::Impl::report_solution(const Solution& solution) {
  report.greatest_opening_deg = stages.input->greatest_opening_deg;
  report.input_shapes = static_cast<int>(stages.input->drive.shapes());
  report.free_dofs = solution.free_dofs;
  report.basis_size = solution.basis_size;
  report.estimated_error = solution.estimated_error;
  report.verified_error = solution.verified_error;
  report.driven_nodes = static_cast<int>(stages.boundary->driven_nodes().size());
  report.skull_nodes = stages.boundary->skull_count();
  report.mandible_nodes = stages.boundary->mandible_count();
  add(report.notes, note_on_reduced_error(solution, options.solver.tolerance));
}

void Simulator::Impl::simulate_tissue(const std::vector<FrameTime>& frame_times,
                                      const PointCurve& points, SimulationResult& result) {
  Stopwatch watch;
  const auto factoring_s = [this] {
    return report.assemble_s + report.analyse_s + report.factor_s;
  };
  const double prepared_s = factoring_s();
  ensure_boundary();
  ensure_pattern();
  report.boundary_s = watch.lap();
  progress.throw_if_cancelled();
  report.steps = options.model.strain == Strain::linear ? steps() : 0;
  ensure_input(points);
  const std::vector<double> times = in_steps(frame_times);
  const bool finite = options.model.strain == Strain::finite;
  Solution solution = finite ? solve_finite(times) : solve_linear(times);
  place_neutral(finite, points, solution, result.performance);
  report.simulate_s = watch.lap() - report.basis_s - (factoring_s() - prepared_s);
  result.performance.node_displacement_m.resize(result.performance.frame_time_s.size());
  progress.report(std::max(progress.done(), kReducedDone));
  progress.for_frames(frame_times.size(), [&](std::size_t i) {
    const Eigen::Map<const Points> nodes(solution.displacement.col(Eigen::Index(i)).data(),
                                         mesh->volume.nodes.rows(), 3);
    store(frame_times[i], nodes, points, result);
  });
  place_jaw(points, result);
  if (options.contact.any()) resolve_contact(frame_times, points, solution, result);
  report_solution(solution);
  describe_tissue(result.performance);
}

SimulationResult Simulator::Impl::run() {
  report = std::exchange(prepared, {});
  const bool finite_contact = options.contact.any() && options.model.strain == Strain::finite;
  progress.begin_part(0, finite_contact ? kBeforeFiniteContact : 1);
  progress.report(0);
  ensure_skin();
  const PointCurve points(*motion, options.drive.gain);
  SimulationResult result;
  const std::vector<FrameTime> frame_times =
      frame_times_of(options.time, end_s(), result.performance.frame_time_s);
  result.performance.skin_displacement_m.resize(result.performance.frame_time_s.size());
  result.still_displacement_m.resize(options.time.still_times_s.size());
  if (options.region.measured == Measured::all) {
    const Points none = Points::Zero(mesh->volume.nodes.rows(), 3);
    progress.for_frames(frame_times.size(),
                        [&](std::size_t i) { store(frame_times[i], none, points, result); });
    place_jaw(points, result);
  } else {
    simulate_tissue(frame_times, points, result);
  }
  Stopwatch watch;
  describe_skin(points, result.performance);
  report.skin_s = watch.lap();
  progress.report(1);
  result.report = report;
  return result;
}

void Simulator::Impl::place_neutral(bool finite, const PointCurve& points, Solution& solution,
                                    Performance& performance) {
  if (!changes_rest()) return;
  if (!finite) {
    solution.neutral = neutral_at_small_strain();
    solution.displacement.colwise() += solution.neutral;
  }
  const Eigen::Map<const Points> nodes(solution.neutral.data(), mesh->volume.nodes.rows(), 3);
  performance.upper_teeth_now_from_rest = stages.moved_bones->upper_teeth;
  performance.neutral_displacement_m =
      stages.readout->skin(stages.measured.value(), stages.points->rim, nodes, points.at(0));
}

PointsF Simulator::Impl::still(double time_s) {
  time_s = std::clamp(time_s, 0.0, end_s());
  report = {};
  ensure_skin();
  const PointCurve points(*motion, options.drive.gain);
  Points nodes = Points::Zero(mesh->volume.nodes.rows(), 3);
  if (options.region.measured != Measured::all) {
    ensure_boundary();
    ensure_pattern();
    // Forces of one instant need no courses over all steps.
    by_forces() ? ensure_load(points) : ensure_input(points);
    ensure_factor();
    fem::ReducedModel& model = stages.factor->model;
    const Eigen::MatrixXd d =
        by_forces()
            ? model.at_rest(force_at(on_moved_bones(stages.load.value()), options.muscles, time_s))
            : model.at_rest(stages.input->drive, in_steps({{time_s, 0}}));
    nodes = Eigen::Map<const Points>(d.data(), nodes.rows(), 3);
    if (const Eigen::VectorXd rest = neutral_at_small_strain(); rest.size() > 0)
      nodes += Eigen::Map<const Points>(rest.data(), nodes.rows(), 3);
  }
  if (report.forces_found_anew) {  // the next run reports it
    prepared.forces_found_anew = true;
    prepared.notes.insert(prepared.notes.end(), report.notes.begin(), report.notes.end());
  }
  return stages.readout->skin(stages.measured.value(), stages.points->rim, nodes,
                              points.at(time_s));
}

}  // namespace hyperex::simulate
