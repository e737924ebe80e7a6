// SPDX-License-Identifier: GPL-3.0-or-later
// A run: from the stages to the frames.
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <thread>
#include <utility>

#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/run/finite_run.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

namespace {

std::vector<Shot> shots_of(const TimeOptions& time, double end_s,
                           std::vector<double>& frame_time_s) {
  std::vector<Shot> shots;
  const int frames = std::max(1, static_cast<int>(std::ceil(end_s * time.frame_rate_hz - 1e-6)));
  for (int f = 0; f < frames; ++f) {
    frame_time_s.push_back(f / time.frame_rate_hz);
    shots.push_back({frame_time_s.back(), f});
  }
  for (std::size_t i = 0; i < time.still_times_s.size(); ++i)
    shots.push_back({std::min(time.still_times_s[i], end_s), -1 - static_cast<int>(i)});
  std::stable_sort(shots.begin(), shots.end(),
                   [](const Shot& a, const Shot& b) { return a.time_s < b.time_s; });
  return shots;
}

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

void Simulator::Impl::tell(double share) {
  ask();
  told = share;
  if (callbacks.progress) callbacks.progress(share);
}

void Simulator::Impl::for_frames(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto caller = std::this_thread::get_id();  // on which callbacks are called
  const double from = told, step = 0.5 * (1 - from) / static_cast<double>(count);
  std::atomic<std::size_t> done{0};
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    body(i);
    const std::size_t now = ++done;
    if (std::this_thread::get_id() == caller) tell(from + step * static_cast<double>(now));
  });
  tell(from + step * static_cast<double>(count));
}

std::optional<fem::Response> Simulator::Impl::response_by_gains(const fem::ReducedOptions& how) {
  if (!by_forces() || load->muscles.names.empty() || options.muscles.mirrored) return {};
  const Eigen::VectorXd change =
      muscle_gains(load->muscles.names, options.muscles.gains, options.muscles.table()).array() - 1;
  Eigen::Index most = 0;
  if (change.cwiseAbs().maxCoeff(&most) == 0) return {};
  const MuscleOptions as_was = as_recorded(options.muscles);
  if (!recorded_response) recorded_response = reduced->run(drive_by(*load, as_was), how);
  // One strength after another of the same muscles adds the same motion, more or less of it.
  const Eigen::VectorXd direction = change / change[most];
  if (!added || added->direction != direction) {
    const fem::Drive drive = drive_by(added_by_gains(*load, direction), as_was);
    fem::ReducedOptions less = how;  // half of the whole's error is enough
    less.allowed_m = 0.5 * how.tolerance * recorded_response->greatest_displacement_m;
    added = AddedResponse{direction, {}};
    if (2 * drive.shapes() <= input->drive.shapes()) added->response = reduced->run(drive, less);
  }
  if (!added->response) return {};
  fem::Response sum = fem::sum_of(*recorded_response, *added->response, change[most]);
  if (!sum.converged || sum.estimated_error > how.tolerance) return {};
  return sum;
}

Solution Simulator::Impl::solved(const std::vector<double>& times) {
  const auto progress = [this](double share) { tell(kDirectDone * share); };
  if (options.solver.method == SolverMethod::direct) {
    need_full();
    return run_full(*full, input->drive, times, progress);
  }
  need_reduced();
  ask();
  Stopwatch watch;
  fem::ReducedOptions how{newmark(), options.solver.tolerance};
  how.between_growths = [this] { ask(); };
  if (!response) response = response_by_gains(how);
  if (!response) response = reduced->run(input->drive, how);
  report.basis_s = watch.lap();
  Solution out = run_reduced(*reduced, *response, times);
  if (!options.solver.verify) return out;
  need_full();
  out.verified_error = greatest_difference(
      out.displacement, run_full(*full, input->drive, times, progress).displacement);
  return out;
}

std::vector<double> Simulator::Impl::finite_times_s() const {
  const double interval_s = options.solver.finite_step_s > 0 ? options.solver.finite_step_s
                                                             : 1 / options.time.frame_rate_hz;
  const double end = end_s();
  const int count = std::max(1, static_cast<int>(std::ceil(end / interval_s - 1e-9)));
  std::vector<double> out;
  for (int k = 0; k <= count; ++k) out.push_back(std::min(k * interval_s, end));
  return out;
}

/// Where the load's patches go at small strain.
NodalCourse Simulator::Impl::patch_places(const std::vector<double>& times_s) {
  need_reduced();
  std::vector<double> times;
  for (const double t : times_s)
    times.push_back(std::min(t / options.time.step_s, double(steps())));
  const Eigen::MatrixXd nodes = reduced
                                    ->run(drive_by(*load, as_recorded(options.muscles)),
                                          {newmark(), options.solver.tolerance})
                                    .displacement(times);
  NodalCourse out;
  out.nodes = load->patch_nodes;
  Eigen::VectorXd at(3 * Eigen::Index(out.nodes.size()));
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    for (std::size_t i = 0; i < out.nodes.size(); ++i)
      at.segment<3>(3 * Eigen::Index(i)) = nodes.col(Eigen::Index(k)).segment<3>(3 * out.nodes[i]);
    out.take(times_s[k], at);
  }
  return out;
}

FiniteSolution Simulator::Impl::run_at_finite_strain(const MuscleOptions& muscles, bool holds,
                                                     const std::vector<double>& times) {
  Stopwatch watch;
  FiniteDrive drive;
  drive.step_s = options.time.step_s;
  const std::vector<double> times_s = finite_times_s();
  NodalCourse places;
  if (holds) {
    places = patch_places(times_s);
    drive.places = &places;
  }
  if (by_forces()) {
    std::vector<char> turning = turning_columns(*load, muscles.table());
    drive.turning = drive_by(with_columns(*load, turning), muscles);
    for (char& turns : turning) turns = !turns;
    drive.still = drive_by(with_columns(*load, turning), muscles);
    if (!holds) drive.forces = load->patch_forces.get();
  } else {
    drive.still = input->drive;
  }
  fem::FiniteStrain form(*assembler, material(), options.model.law);
  fem::SparseMatrix springs = assembler->stiffness_pattern();
  boundary->add_springs(springs);
  springs.prune(0.0);
  report.assemble_s += watch.lap();
  fem::FiniteNewtonOptions how;
  how.tolerance = options.solver.finite_tolerance;
  how.full_newton = options.solver.full_newton;
  std::vector<int> prescribed = boundary->prescribed();
  if (holds) prescribed = with_nodes(prescribed, places.nodes);
  auto order_now = known_order();
  if (holds && order_now)
    order_now = std::make_shared<const fem::NodeOrder>(
        restricted(*order_now, int(springs.cols()), boundary->prescribed(), prescribed));
  fem::FiniteNewton newton(form, std::move(prescribed), how, std::move(springs), {},
                           options.solver.linear, order_now);
  if (!holds) keep_order(newton.order());
  report.factor_s += watch.lap();
  FiniteSolution out = run_finite(newton, *assembler, boundary->prescribed(), drive, times_s, times,
                                  [this](double share) { tell(kDirectDone * share); });
  report.steps += out.parts;
  report.iterations += out.iterations;
  report.factorisations += out.factorisations;
  return out;
}

Solution Simulator::Impl::solved_finite(const std::vector<double>& times) {
  if (load_held && load && load->patch_forces && load->patch_forces->time_s.back() < end_s() - 1e-9)
    throw InputError("time.end_s",
                     fmt::format("{:g} s: forces are held of a run of {:g} s; expected no more",
                                 end_s(), load->patch_forces->time_s.back()));
  if (!by_forces() || (load_held && load->patch_forces))
    return std::move(run_at_finite_strain(options.muscles, false, times).solution);
  // What holds the patches belongs to the motion as it was recorded, whatever the gains.
  FiniteSolution recorded = run_at_finite_strain(as_recorded(options.muscles), true, times);
  HeldLoad whole = *load;
  whole.patch_forces = std::make_shared<const NodalCourse>(std::move(recorded.reactions));
  load = std::make_shared<const HeldLoad>(std::move(whole));
  if (options.muscles == as_recorded(options.muscles)) return std::move(recorded.solution);
  return std::move(run_at_finite_strain(options.muscles, false, times).solution);
}

void Simulator::Impl::integrate(const std::vector<Shot>& shots, const PointCurve& points,
                                SimulationResult& result) {
  Stopwatch watch;
  const auto factoring_s = [this] {
    return report.assemble_s + report.analyse_s + report.factor_s;
  };
  const double prepared_s = factoring_s();
  need_boundary();
  need_assembler();
  report.boundary_s = watch.lap();
  ask();
  report.steps = options.model.strain == Strain::linear ? steps() : 0;
  need_input(points);
  std::vector<double> times;
  for (const Shot& shot : shots)
    times.push_back(
        std::clamp(shot.time_s / options.time.step_s, 0.0, static_cast<double>(steps())));
  const bool finite = options.model.strain == Strain::finite;
  Solution solution = finite ? solved_finite(times) : solved(times);
  report.simulate_s = watch.lap() - report.basis_s - (factoring_s() - prepared_s);
  result.performance.node_displacement_m.resize(result.performance.frame_time_s.size());
  tell(std::max(told, kReducedDone));
  for_frames(shots.size(), [&](std::size_t i) {
    const Eigen::Map<const Points> nodes(solution.displacement.col(i).data(),
                                         mesh->volume.nodes.rows(), 3);
    store(shots[i], nodes, points, result);
  });
  place_jaw(points, result);
  if (options.contact.any()) touch(shots, points, solution, result);
  report.greatest_opening_deg = input->greatest_opening_deg;
  report.input_shapes = static_cast<int>(input->drive.shapes());
  report.free_dofs = solution.free_dofs;
  report.basis_size = solution.basis_size;
  report.linear_solver = solution.linear_solver;
  report.estimated_error = solution.estimated_error;
  report.verified_error = solution.verified_error;
  report.driven_nodes = static_cast<int>(boundary->driven_nodes().size());
  report.skull_nodes = boundary->skull_count();
  report.mandible_nodes = boundary->mandible_count();
  if (!solution.converged)
    report.notes.push_back(
        fmt::format("The reduced model stopped growing at {} vectors with an estimated error of "
                    "{:.1e}, above the wanted {:g}: solving for all unknowns at every step (the "
                    "direct method) has no such error.",
                    solution.basis_size, solution.estimated_error, options.solver.tolerance));
  describe_tissue(result.performance);
}

void Simulator::Impl::place_jaw(const PointCurve& points, SimulationResult& result) const {
  std::vector<double> times_s = result.performance.frame_time_s;
  for (const double t : options.time.still_times_s) times_s.push_back(std::min(t, end_s()));
  auto jaw = jaw_now_from_rest(times_s, points);
  const auto stills = jaw.begin() + std::ptrdiff_t(result.performance.frame_time_s.size());
  result.still_jaw_now_from_rest.assign(stills, jaw.end());
  jaw.erase(stills, jaw.end());
  result.performance.jaw_now_from_rest = std::move(jaw);
}

void Simulator::Impl::store(const Shot& shot, const Points& nodes, const PointCurve& points,
                            SimulationResult& result) const {
  const PointsF skin = readout->skin(*region, driven_points->rim, nodes, points.at(shot.time_s));
  Performance& p = result.performance;
  if (shot.frame < 0) {
    result.still_displacement_m[-1 - shot.frame] = skin;
  } else {
    p.skin_displacement_m[shot.frame] = skin;
    if (!p.node_displacement_m.empty())
      p.node_displacement_m[shot.frame] = in_single_precision(nodes);
  }
}

void Simulator::Impl::describe_tissue(Performance& p) {
  p.nodes = mesh->volume.nodes;
  p.tets = mesh->volume.tets;
  p.model = options.model;
  const fem::Material values = material();
  p.tet_young_pa = floats(values.young_pa);
  p.tet_poisson = floats(values.poisson);
  p.tet_viscosity_pa_s = floats(values.viscosity_pa_s);
  const std::vector<int> held = boundary->held_nodes();
  p.held_points_rest.resize(held.size(), 3);
  for (std::size_t i = 0; i < held.size(); ++i)
    p.held_points_rest.row(i) = mesh->volume.nodes.row(held[i]);
  if (callbacks.skin_alone) return;
  std::vector<int> inverted(p.node_displacement_m.size());
  for_frames(inverted.size(), [&](std::size_t f) {
    const auto marks = fem::inverted_tets(p.nodes, p.tets, p.node_displacement_m[f].cast<double>());
    inverted[f] = static_cast<int>(std::count(marks.begin(), marks.end(), 1));
  });
  report.inverted_tets = *std::max_element(inverted.begin(), inverted.end());
}

void Simulator::Impl::describe(const PointCurve& points, Performance& p) {
  p.skin_rest = mesh->skin;
  p.scan_vertices = mesh->scan_vertices;
  p.appended = mesh->appended;
  p.source_triangle = mesh->source_triangle;
  p.lip_cut_rest = mesh->lip_cut;
  p.landmarks = readout->landmark_tracks(p.frame_time_s, p.skin_displacement_m);
  p.driven_names = driven_points->names;
  p.driven_points_rest = driven_points->rest;
  if (load) p.muscles = changed_muscles(load->muscles, options.muscles);
  p.peak_frame = peak_frame(p.frame_time_s, options.time.peak_time_s, driven_points->rows, points);
  if (callbacks.skin_alone) return;
  const Readout::Lips lips =
      readout->lips(p.landmarks, p.skin_displacement_m,
                    [this](std::size_t count, const auto& frame) { for_frames(count, frame); });
  report.lip_overlap_mm = lips.overlap_mm;
  report.lip_gap_mm = lips.gap_mm;
  note_driven_off(driven_points->off_m(p, points), p.driven_names);
}

void Simulator::Impl::note_driven_off(const std::vector<double>& off_m,
                                      const std::vector<std::string>& points) {
  std::string names;
  for (std::size_t i = 0; i < off_m.size(); ++i) {
    report.driven_off_mm = std::max(report.driven_off_mm, 1e3 * off_m[i]);
    if (off_m[i] > kDrivenWithin_m) names += (names.empty() ? "" : ", ") + points[i];
  }
  if (!names.empty())
    report.notes.push_back(
        fmt::format("driven points end up to {:.2f} mm from where they are driven: {}; points "
                    "that lie closer together than the elements and move differently are met in "
                    "the mean",
                    report.driven_off_mm, names));
}

SimulationResult Simulator::Impl::run() {
  report = std::exchange(prepared, {});
  tell(0);
  need_region();
  const PointCurve points(*motion, options.drive.gain);
  SimulationResult result;
  const std::vector<Shot> shots = shots_of(options.time, end_s(), result.performance.frame_time_s);
  result.performance.skin_displacement_m.resize(result.performance.frame_time_s.size());
  result.still_displacement_m.resize(options.time.still_times_s.size());
  if (options.region.measured == Measured::all) {
    const Points none = Points::Zero(mesh->volume.nodes.rows(), 3);
    for_frames(shots.size(), [&](std::size_t i) { store(shots[i], none, points, result); });
    place_jaw(points, result);
  } else {
    integrate(shots, points, result);
  }
  Stopwatch watch;
  describe(points, result.performance);
  report.skin_s = watch.lap();
  tell(1);
  result.report = report;
  return result;
}

PointsF Simulator::Impl::still(double time_s) {
  time_s = std::clamp(time_s, 0.0, end_s());
  report = {};
  need_region();
  const PointCurve points(*motion, options.drive.gain);
  Points nodes = Points::Zero(mesh->volume.nodes.rows(), 3);
  if (options.region.measured != Measured::all) {
    need_boundary();
    need_assembler();
    // Forces of one instant need no courses over all steps.
    by_forces() ? need_load(points) : need_input(points);
    need_reduced();
    const Eigen::MatrixXd d =
        by_forces()
            ? reduced->at_rest(force_at(*load, options.muscles, time_s))
            : reduced->at_rest(input->drive,
                               {std::clamp(time_s / options.time.step_s, 0.0, double(steps()))});
    nodes = Eigen::Map<const Points>(d.data(), nodes.rows(), 3);
  }
  if (report.forces_found_anew) {  // told by the next run
    prepared.forces_found_anew = true;
    prepared.notes.push_back(kForcesFoundAnew);
  }
  return readout->skin(*region, driven_points->rim, nodes, points.at(time_s));
}

}  // namespace hyperex::simulate
