// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/simulator.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <type_traits>

#include "hyperex/core/error.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/form/inverted.hpp"
#include "hyperex/fem/reduced/reduced_model.hpp"
#include "hyperex/reenact/boundary.hpp"
#include "hyperex/reenact/held_load.hpp"
#include "hyperex/reenact/input_shapes.hpp"
#include "hyperex/reenact/muscle_load.hpp"
#include "hyperex/reenact/readout.hpp"
#include "hyperex/reenact/solve.hpp"
#include "hyperex/reenact/stream.hpp"

namespace hyperex::reenact {
namespace {

/// A time at which a shape is wanted, and where it goes.
struct Shot {
  double time_s;
  int frame;  ///< or -1 - index of a still
};

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

bool same_but_gain(DriveOptions a, const DriveOptions& b) {
  a.gain = b.gain;
  return a == b;
}

bool same_but_gains(MuscleOptions a, const MuscleOptions& b) {
  a.gains = b.gains;
  a.mirrored = b.mirrored;
  return a == b;
}

std::vector<float> floats(const std::vector<double>& values) {
  return {values.begin(), values.end()};
}

}  // namespace

struct Simulator::Impl {
  // Given.
  std::shared_ptr<const tissue::TissueMesh> mesh;
  std::shared_ptr<const io::Landmarks> landmarks;
  std::shared_ptr<const AlignedMotion> motion;
  SimulationOptions options;

  // Stages in the order of the header's table; null where they are still to be computed. What
  // copies may share is const.
  std::shared_ptr<const Readout> readout;  // of the face alone
  std::shared_ptr<const MeasuredRegion> region;
  std::shared_ptr<const DrivenPoints> driven_points;
  std::shared_ptr<const DrivenSkin> driven;
  std::shared_ptr<const Boundary> boundary;
  std::shared_ptr<const fem::Assembler> assembler;
  struct Order {
    std::vector<int> prescribed;
    std::shared_ptr<const fem::NodeOrder> nodes;
  };
  std::shared_ptr<const Order> order;
  std::shared_ptr<const HeldLoad> load;
  bool load_held = false;
  std::shared_ptr<const InputShapes> input;
  // Of this simulator alone.
  std::optional<fem::ReducedModel> reduced;
  std::optional<fem::Newmark> full;
  bool reduced_current = false, full_current = false;  // with the tissue that is set
  std::optional<fem::Response> response;

  std::optional<Stream> stream;
  bool stream_current = false, stream_fits = false;  // with the values; with the pattern and order

  SimulationReport report;
  RunCallbacks callbacks;

  // ----- what is left when something is set

  void drop_values() {
    reduced_current = full_current = false, response.reset();
    stream_current = false;
  }
  void drop_factors() {
    reduced.reset();
    full.reset();
    stream_fits = false;
    drop_values();
  }
  void drop_input() {
    input.reset();
    response.reset();
  }
  /// Of what it was found in: tissue and support; held, it stays.
  void drop_load() {
    if (load_held || !by_forces()) return;
    load.reset();
    drop_input();
  }
  void drop_boundary() {
    boundary.reset();
    drop_load();
    drop_input();
    drop_values();  // the springs' stiffness; the factors go where other nodes are prescribed
  }
  void drop_driven() {
    driven.reset();
    driven_points.reset();
    load.reset();
    drop_boundary();
  }
  void drop_region() {
    region.reset();
    drop_driven();
  }

  void set(SimulationOptions next) {
    check(next);
    const SimulationOptions before = std::move(options);
    options = std::move(next);
    if (options.region != before.region) drop_region();
    if (!same_but_gain(before.drive, options.drive)) drop_driven();
    if (options.drive.gain != before.drive.gain) {
      load.reset();
      drop_input();
    }
    if (!same_but_gains(before.muscles, options.muscles)) drop_driven();
    if (before.muscles != options.muscles) drop_input();
    if (options.support != before.support) drop_boundary();
    if (options.model.element != before.model.element) {
      assembler.reset();
      order.reset();
      drop_factors();
    }
    if (options.model != before.model || options.tissue != before.tissue) {
      drop_values();
      drop_load();
    }
    if (options.solver.linear != before.solver.linear) drop_factors();
    if (options.solver.newmark_beta != before.solver.newmark_beta ||
        options.solver.newmark_gamma != before.solver.newmark_gamma ||
        options.time.step_s != before.time.step_s)
      full.reset();
    if (options.solver != before.solver) drop_input();
    if (options.time.step_s != before.time.step_s || options.time.end_s != before.time.end_s) {
      if (options.drive.by == DriveBy::reactions) load.reset();  // at steps
      drop_input();
    }
  }

  template <class Part>
  void set_part(Part SimulationOptions::*part, Part value) {
    SimulationOptions next = options;
    next.*part = std::move(value);
    set(std::move(next));
  }

  void set(AlignedMotion next) {
    motion = std::make_shared<const AlignedMotion>(std::move(next));
    drop_region();
  }

  // ----- stages

  void ask() const {
    if (callbacks.cancelled && callbacks.cancelled()) throw Cancelled();
  }

  double end_s() const {
    const auto& times = motion->motion.time_s;
    return options.time.end_s > 0 ? options.time.end_s : times.back() - times.front();
  }

  int steps() const {
    const double steps = std::ceil(end_s() / options.time.step_s - 1e-9);
    if (steps > kMostSteps)
      throw InputError(motion->motion.source,
                       fmt::format("{:g} s in steps of {:g} s are {:.0f} steps; expected at most "
                                   "{:.0f}",
                                   end_s(), options.time.step_s, steps, kMostSteps));
    return static_cast<int>(steps);
  }

  void need_region() {
    if (!readout) readout = std::make_shared<const Readout>(*mesh, *landmarks);
    if (!region)
      region = std::make_shared<const MeasuredRegion>(
          measured_region(*mesh, *landmarks, *motion, options.region));
  }

  bool by_forces() const { return options.drive.by != DriveBy::displacement; }

  void need_boundary() {
    if (!boundary && options.drive.by == DriveBy::muscles) {
      boundary = std::make_shared<const Boundary>(*mesh, *landmarks,
                                                  muscle_support(options.support, options.muscles));
      keep_or_drop_order();
      return;
    }
    if (!driven)
      driven = std::make_shared<const DrivenSkin>(
          driven_skin(*mesh, *landmarks, *motion, *region, options.drive));
    if (!boundary) {
      const Boundary whole(*mesh, *landmarks, *motion, driven, options.support);
      boundary = std::make_shared<const Boundary>(by_forces() ? whole.released() : whole);
    }
    keep_or_drop_order();
  }

  void keep_or_drop_order() {
    if (order && order->prescribed != boundary->prescribed()) {
      order.reset();
      drop_factors();
    }
  }

  fem::Material material() const {
    fem::Material out = options.tissue.material(static_cast<std::size_t>(mesh->volume.tets.rows()),
                                                options.model.viscous_form);
    if (options.drive.by == DriveBy::muscles) stiffen_lips(*mesh, *landmarks, options.muscles, out);
    return out;
  }

  void need_assembler() {
    if (!assembler)
      assembler = std::make_shared<const fem::Assembler>(mesh->volume.nodes, mesh->volume.tets,
                                                         options.model.element);
  }

  /// The matrices with the tissue and the support that are set, over patterns that are there.
  void fill(fem::System& system) {
    Stopwatch watch;
    assembler->assemble(material(), system);
    boundary->add_springs(system.stiffness);
    report.assemble_s += watch.lap();
  }

  /// Makes a factor or refills it: `Model` is fem::ReducedModel or fem::Newmark.
  template <class Model, class Make>
  void need_factor(std::optional<Model>& model, bool& current, Make make) {
    if (model && current) return;
    current = false;
    if (model) {
      fem::System system;
      if constexpr (std::is_same_v<Model, fem::ReducedModel>) system = model->release();
      fill(system);
      model->refill(std::move(system));
    } else {
      fem::System system;
      fill(system);
      model.emplace(make(std::move(system)));
      report.analyse_s += model->analyse_seconds();
      keep_order(model->order());
    }
    report.factor_s += model->factor_seconds();
    current = true;
  }

  fem::NewmarkOptions newmark() const {
    return {options.time.step_s, options.solver.newmark_beta, options.solver.newmark_gamma};
  }
  std::shared_ptr<const fem::NodeOrder> known_order() const {
    return order ? order->nodes : nullptr;
  }
  void keep_order(const std::shared_ptr<const fem::NodeOrder>& nodes) {
    if (!order) order = std::make_shared<const Order>(Order{boundary->prescribed(), nodes});
  }

  void need_reduced() {
    need_factor(reduced, reduced_current, [&](fem::System system) {
      return fem::ReducedModel(std::move(system), boundary->prescribed(), options.solver.linear,
                               known_order());
    });
  }
  void need_full() {
    need_factor(full, full_current, [&](fem::System system) {
      return fem::Newmark(std::move(system), boundary->prescribed(), newmark(),
                          options.solver.linear, known_order());
    });
  }

  /// The forces that make the motion in the tissue that is set.
  void need_load(const PointCurve& points) {
    if (load || !by_forces()) return;
    if (options.region.measured != Measured::none)
      throw InputError("drive.by",
                       "forces cannot drive a face of which a region follows the recording "
                       "(region.measured): expected drive.by = \"displacement\"");
    fem::System system;
    assembler->assemble(material(), system);
    if (options.drive.by == DriveBy::muscles) {
      std::shared_ptr<const fem::NodeOrder> nodes = known_order();
      load = std::make_shared<const HeldLoad>(
          muscle_load(*mesh, *landmarks, *motion, *region, options, system.stiffness, nodes));
      keep_order(nodes);
      return;
    }
    Boundary whole(*mesh, *landmarks, *motion, driven, options.support);
    whole.add_springs(system.stiffness);
    const InputShapes shapes = input_shapes(
        whole, [&](double t) { return points.at(t); }, options.time.step_s, steps(),
        1e-3 * options.solver.tolerance);
    HeldLoad found =
        reactions_of(shapes.drive, system.stiffness, whole.prescribed(), options.time.step_s);
    found.greatest_opening_deg = shapes.greatest_opening_deg;
    load = std::make_shared<const HeldLoad>(std::move(found));
  }

  void need_input(const PointCurve& points) {
    if (input) return;
    if (by_forces()) {
      need_load(points);
      input = std::make_shared<const InputShapes>(
          InputShapes{drive_of(*load, options.muscles, options.time.step_s, steps(),
                               1e-3 * options.solver.tolerance,
                               static_cast<Eigen::Index>(boundary->prescribed().size())),
                      load->greatest_opening_deg});
      return;
    }
    // Following the jaw begins at its last position: of this run, not of the one before.
    Boundary own = *boundary;
    // What the shapes leave out must not show beside the error that the solver may make.
    input = std::make_shared<const InputShapes>(input_shapes(
        own, [&](double t) { return points.at(t); }, options.time.step_s, steps(),
        1e-3 * options.solver.tolerance));
  }

  // ----- a run

  Solution solved(const std::vector<double>& times) {
    const auto progress = [this](double share) {
      ask();
      if (callbacks.progress) callbacks.progress(share);
    };
    if (options.solver.method == SolverMethod::direct) {
      need_full();
      return run_full(*full, input->drive, times, progress);
    }
    need_reduced();
    ask();
    Stopwatch watch;
    if (!response) response = reduced->run(input->drive, {newmark(), options.solver.tolerance});
    report.basis_s = watch.lap();
    Solution out = run_reduced(*reduced, *response, times);
    if (!options.solver.verify) return out;
    need_full();
    out.verified_error = greatest_difference(
        out.displacement, run_full(*full, input->drive, times, progress).displacement);
    return out;
  }

  void integrate(const std::vector<Shot>& shots, const PointCurve& points,
                 SimulationResult& result) {
    Stopwatch watch;
    need_boundary();
    need_assembler();
    report.boundary_s = watch.lap();
    ask();
    report.steps = steps();
    need_input(points);
    std::vector<double> times;
    for (const Shot& shot : shots)
      times.push_back(
          std::clamp(shot.time_s / options.time.step_s, 0.0, static_cast<double>(report.steps)));
    const Solution solution = solved(times);
    report.simulate_s =
        watch.lap() - report.basis_s - (report.assemble_s + report.analyse_s + report.factor_s);
    result.performance.node_displacement_m.resize(result.performance.frame_time_s.size());
    tbb::parallel_for(std::size_t(0), shots.size(), [&](std::size_t i) {
      store(shots[i],
            Eigen::Map<const Points>(solution.displacement.col(i).data(), mesh->volume.nodes.rows(),
                                     3),
            points, result);
    });
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

  void store(const Shot& shot, const Points& nodes, const PointCurve& points,
             SimulationResult& result) const {
    const PointsF skin = readout->skin(*region, nodes, points.at(shot.time_s));
    Performance& p = result.performance;
    if (shot.frame < 0) {
      result.still_displacement_m[-1 - shot.frame] = skin;
    } else {
      p.skin_displacement_m[shot.frame] = skin;
      if (!p.node_displacement_m.empty())
        p.node_displacement_m[shot.frame] = in_single_precision(nodes);
    }
  }

  void describe_tissue(Performance& p) {
    p.nodes = mesh->volume.nodes;
    p.tets = mesh->volume.tets;
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
    tbb::parallel_for(std::size_t(0), inverted.size(), [&](std::size_t f) {
      const auto marks =
          fem::inverted_tets(p.nodes, p.tets, p.node_displacement_m[f].cast<double>());
      inverted[f] = static_cast<int>(std::count(marks.begin(), marks.end(), 1));
    });
    report.inverted_tets = *std::max_element(inverted.begin(), inverted.end());
  }

  /// Everything but the frames themselves.
  void describe(const PointCurve& points, Performance& p) {
    p.skin_rest = mesh->skin;
    p.scan_vertices = mesh->scan_vertices;
    p.appended = mesh->appended;
    p.source_triangle = mesh->source_triangle;
    p.lip_cut_rest = mesh->lip_cut;
    p.landmarks = readout->landmark_tracks(p.frame_time_s, p.skin_displacement_m);
    if (!driven_points)
      driven_points = std::make_shared<const DrivenPoints>(*mesh, *motion,
                                                           options.drive.names_in(motion->motion));
    p.driven_names = driven_points->names;
    p.driven_points_rest = driven_points->rest;
    if (load) p.muscles = changed_muscles(load->muscles, options.muscles);
    p.peak_frame =
        peak_frame(p.frame_time_s, options.time.peak_time_s, driven_points->rows, points);
    if (callbacks.skin_alone) return;
    const Readout::Lips lips = readout->lips(p.landmarks, p.skin_displacement_m);
    report.lip_overlap_mm = lips.overlap_mm;
    report.lip_gap_mm = lips.gap_mm;
    note_driven_off(driven_points->off_m(p, points), p.driven_names);
  }

  void note_driven_off(const std::vector<double>& off_m, const std::vector<std::string>& points) {
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

  // ----- a stream

  void start_stream(double interval_s) {
    if (!(interval_s > 0))
      throw InputError("stream",
                       fmt::format("interval_s = {:g}: expected more than 0 s", interval_s));
    if (options.region.measured == Measured::all)
      throw InputError("stream", "the whole skin is measured: there is nothing to simulate");
    if (by_forces())
      throw InputError("stream", "forces need the whole motion: expected drive.by = displacement");
    stream.reset();
    renew_stream(interval_s);
  }

  /// With what is set now: the motion goes on where the pattern and the driven nodes are the same.
  void renew_stream(double interval_s) {
    need_region();
    need_boundary();
    need_assembler();
    fem::System system;
    fill(system);
    if (stream && stream_fits) {
      stream->refill(std::move(system), *boundary);
    } else {
      stream.emplace(std::move(system), *boundary, interval_s, options.solver.linear,
                     known_order());
      keep_order(stream->order());
    }
    stream_current = stream_fits = true;
  }

  PointsF step(const Points& displacement_m) {
    if (!stream) throw std::logic_error("Simulator::step before start_stream");
    if (displacement_m.rows() != motion->rest.rows() || !displacement_m.allFinite())
      throw InputError("stream", fmt::format("{} rows: expected {} points, all finite",
                                             displacement_m.rows(), motion->rest.rows()));
    if (!stream_current) renew_stream(stream->interval_s());
    const Points points = options.drive.gain * displacement_m;
    return readout->skin(*region, stream->step(points), points);
  }

  void prepare() {
    need_region();
    if (options.region.measured == Measured::all) return;  // nothing is simulated
    run_together({[&] { need_boundary(); }, [&] { need_assembler(); }});
  }

  SimulationResult run() {
    report = {};
    ask();
    need_region();
    const PointCurve points(*motion, options.drive.gain);
    SimulationResult result;
    const std::vector<Shot> shots =
        shots_of(options.time, end_s(), result.performance.frame_time_s);
    result.performance.skin_displacement_m.resize(result.performance.frame_time_s.size());
    result.still_displacement_m.resize(options.time.still_times_s.size());
    if (options.region.measured == Measured::all) {
      const Points none = Points::Zero(mesh->volume.nodes.rows(), 3);
      for (const Shot& shot : shots) store(shot, none, points, result);
    } else {
      integrate(shots, points, result);
    }
    Stopwatch watch;
    describe(points, result.performance);
    report.skin_s = watch.lap();
    result.report = report;
    return result;
  }
};

Simulator::Simulator(std::shared_ptr<const tissue::TissueMesh> mesh, io::Landmarks landmarks,
                     AlignedMotion motion, SimulationOptions options)
    : impl_(std::make_unique<Impl>()) {
  check(options);
  impl_->mesh = std::move(mesh);
  impl_->landmarks = std::make_shared<const io::Landmarks>(std::move(landmarks));
  impl_->motion = std::make_shared<const AlignedMotion>(std::move(motion));
  impl_->options = std::move(options);
}

Simulator::Simulator(const Simulator& other) : impl_(std::make_unique<Impl>()) {
  const Impl& from = *other.impl_;
  impl_->mesh = from.mesh;
  impl_->landmarks = from.landmarks;
  impl_->motion = from.motion;
  impl_->options = from.options;
  impl_->readout = from.readout;
  impl_->region = from.region;
  impl_->driven = from.driven;
  impl_->driven_points = from.driven_points;
  impl_->boundary = from.boundary;
  impl_->assembler = from.assembler;
  impl_->order = from.order;
  impl_->load = from.load;
  impl_->load_held = from.load_held;
  impl_->input = from.input;
}
Simulator::Simulator(Simulator&&) noexcept = default;
Simulator& Simulator::operator=(Simulator other) noexcept {
  impl_.swap(other.impl_);
  return *this;
}
Simulator::~Simulator() = default;

const SimulationOptions& Simulator::options() const {
  return impl_->options;
}
const tissue::TissueMesh& Simulator::mesh() const {
  return *impl_->mesh;
}
const io::Landmarks& Simulator::landmarks() const {
  return *impl_->landmarks;
}
const AlignedMotion& Simulator::motion() const {
  return *impl_->motion;
}

void Simulator::set_options(SimulationOptions options) {
  impl_->set(std::move(options));
}
void Simulator::set_tissue(TissueValues tissue) {
  impl_->set_part(&SimulationOptions::tissue, std::move(tissue));
}
void Simulator::set_support(SupportOptions support) {
  impl_->set_part(&SimulationOptions::support, std::move(support));
}
void Simulator::set_drive(DriveOptions drive) {
  impl_->set_part(&SimulationOptions::drive, std::move(drive));
}
void Simulator::set_motion(AlignedMotion motion) {
  impl_->set(std::move(motion));
}
void Simulator::hold_load() {
  impl_->load_held = true;
}

SimulationResult simulate(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                          const AlignedMotion& motion, const SimulationOptions& options,
                          const RunCallbacks& callbacks) {
  const std::shared_ptr<const tissue::TissueMesh> borrowed(std::shared_ptr<void>(), &mesh);
  return Simulator(borrowed, landmarks, motion, options).run(callbacks);
}

void Simulator::start_stream(double interval_s) {
  impl_->callbacks = {};
  impl_->start_stream(interval_s);
}
PointsF Simulator::step(const Points& displacement_m) {
  return impl_->step(displacement_m);
}

void Simulator::prepare() {
  impl_->prepare();
}

SimulationResult Simulator::run(const RunCallbacks& callbacks) {
  impl_->callbacks = callbacks;
  return impl_->run();
}

}  // namespace hyperex::reenact
