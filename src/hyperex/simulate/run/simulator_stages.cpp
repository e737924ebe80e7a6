// SPDX-License-Identifier: GPL-3.0-or-later
// The stages: each is computed when it is needed and not there.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {

void Simulator::Impl::ask() const {
  if (callbacks.cancelled && callbacks.cancelled()) throw Cancelled();
}

double Simulator::Impl::end_s() const {
  const auto& times = motion->motion.time_s;
  return options.time.end_s > 0 ? options.time.end_s : times.back() - times.front();
}

int Simulator::Impl::steps() const {
  const double steps = std::ceil(end_s() / options.time.step_s - 1e-9);
  if (steps > kMostSteps)
    throw InputError(motion->motion.source,
                     fmt::format("{:g} s in steps of {:g} s are {:.0f} steps; expected at most "
                                 "{:.0f}",
                                 end_s(), options.time.step_s, steps, kMostSteps));
  return static_cast<int>(steps);
}

void Simulator::Impl::need_region() {
  if (!driven_points)
    driven_points = std::make_shared<const DrivenPoints>(*mesh, *motion,
                                                         options.drive.names_in(motion->motion));
  if (!readout) readout = std::make_shared<const Readout>(*mesh, *landmarks);
  if (!region)
    region = std::make_shared<const MeasuredRegion>(
        measured_region(*mesh, *landmarks, *motion, options.region));
}

bool Simulator::Impl::by_forces() const {
  return options.drive.by != DriveBy::displacement;
}

void Simulator::Impl::need_boundary() {
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

void Simulator::Impl::keep_or_drop_order() {
  if (order && order->prescribed != boundary->prescribed()) {
    order.reset();
    drop_factors();
  }
}

void Simulator::Impl::take_factor(Impl& spent) {
  const bool same_order = order && spent.order && order->prescribed == spent.order->prescribed &&
                          order->nodes->unknowns == spent.order->nodes->unknowns;
  if (!same_order || assembler != spent.assembler ||
      options.solver.linear != spent.options.solver.linear)
    return;
  reduced = std::exchange(spent.reduced, std::nullopt);
  reduced_values = std::exchange(spent.reduced_values, std::nullopt);
  reduced_current = false;
}

fem::Material Simulator::Impl::material() const {
  fem::Material out = options.tissue.material(static_cast<std::size_t>(mesh->volume.tets.rows()),
                                              options.model.viscous_form);
  if (options.drive.by == DriveBy::muscles) stiffen_lips(*mesh, *landmarks, options.muscles, out);
  return out;
}

void Simulator::Impl::need_assembler() {
  if (!assembler)
    assembler = std::make_shared<const fem::Assembler>(mesh->volume.nodes, mesh->volume.tets,
                                                       options.model.element);
}

void Simulator::Impl::fill(fem::System& system) {
  Stopwatch watch;
  assembler->assemble(material(), system);
  boundary->add_springs(system.stiffness);
  report.assemble_s += watch.lap();
}

template <class Model, class Make>
void Simulator::Impl::need_factor(std::optional<Model>& model, bool& current, Make make) {
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

fem::NewmarkOptions Simulator::Impl::newmark() const {
  return {options.time.step_s, options.solver.newmark_beta, options.solver.newmark_gamma};
}

std::shared_ptr<const fem::NodeOrder> Simulator::Impl::known_order() const {
  return order ? order->nodes : nullptr;
}

void Simulator::Impl::keep_order(const std::shared_ptr<const fem::NodeOrder>& nodes) {
  if (!order)
    order =
        std::make_shared<const EliminationOrder>(EliminationOrder{boundary->prescribed(), nodes});
}

bool Simulator::Impl::Values::operator==(const Values& other) const {
  return tissue == other.tissue && model == other.model && by == other.by &&
         muscles == other.muscles && boundary->same_springs(*other.boundary);
}

Simulator::Impl::Values Simulator::Impl::values() const {
  return {options.tissue, options.model, options.drive.by, as_recorded(options.muscles), boundary};
}

void Simulator::Impl::need_reduced() {
  // A mirrored twin often has the very matrices of the run whose factor it takes.
  if (reduced && !reduced_current && reduced_values && *reduced_values == values())
    reduced_current = true;
  if (reduced && reduced_current) return;
  reduced_values.reset();
  need_factor(reduced, reduced_current, [&](fem::System system) {
    return fem::ReducedModel(std::move(system), boundary->prescribed(), options.solver.linear,
                             known_order());
  });
  reduced_values = values();
}

void Simulator::Impl::need_full() {
  need_factor(full, full_current, [&](fem::System system) {
    return fem::Newmark(std::move(system), boundary->prescribed(), newmark(), options.solver.linear,
                        known_order());
  });
}

struct Simulator::Impl::KnownMuscles {
  SimulationOptions of;  // what the model rests on, all else by default
  MuscleModel model;
};

const MuscleModel& Simulator::Impl::need_muscles() {
  SimulationOptions of;
  of.model = options.model;
  of.tissue = options.tissue;
  of.support = options.support;
  of.muscles = as_recorded(options.muscles);
  if (!known_muscles || !(known_muscles->of == of)) {
    fem::System system;
    assembler->assemble(material(), system);
    known_muscles = std::make_shared<const KnownMuscles>(
        KnownMuscles{of, muscle_model(*mesh, *landmarks, options, system.stiffness, known_order(),
                                      [this] { ask(); })});
  }
  keep_order(known_muscles->model.order());
  return known_muscles->model;
}

void Simulator::Impl::need_load(const PointCurve& points) {
  if (load || !by_forces()) return;
  if (options.region.measured != Measured::none)
    throw InputError("drive.by",
                     "forces cannot drive a face of which a region follows the recording "
                     "(region.measured): expected drive.by = \"displacement\"");
  if (options.drive.by == DriveBy::muscles) {
    load = std::make_shared<const HeldLoad>(muscle_load(
        *mesh, *landmarks, *motion, *region, options, need_muscles(), [this] { ask(); }));
    note_found_anew();
    return;
  }
  fem::System system;
  assembler->assemble(material(), system);
  Boundary whole(*mesh, *landmarks, *motion, driven, options.support);
  whole.add_springs(system.stiffness);
  const InputShapes shapes = input_shapes(
      whole, [&](double t) { return points.at(t); }, options.time.step_s, steps(),
      1e-3 * options.solver.tolerance);
  HeldLoad found =
      reactions_of(shapes.drive, system.stiffness, whole.prescribed(), options.time.step_s);
  found.greatest_opening_deg = shapes.greatest_opening_deg;
  load = std::make_shared<const HeldLoad>(std::move(found));
  note_found_anew();
}

void Simulator::Impl::note_found_anew() {
  if (!load_lost) return;
  load_lost = false;
  report.forces_found_anew = true;
  report.notes.push_back(kForcesFoundAnew);
}

fem::Drive Simulator::Impl::drive_by(const HeldLoad& forces, const MuscleOptions& muscles) const {
  return drive_of(forces, muscles, options.time.step_s, steps(), 1e-3 * options.solver.tolerance,
                  static_cast<Eigen::Index>(boundary->prescribed().size()));
}

void Simulator::Impl::need_input(const PointCurve& points) {
  if (input) return;
  if (by_forces()) {
    need_load(points);
    input = std::make_shared<const InputShapes>(
        InputShapes{drive_by(*load, options.muscles), load->greatest_opening_deg});
    return;
  }
  // Following the jaw begins at its last position: of this run, not of the one before.
  Boundary own = *boundary;
  // What the shapes leave out must not show beside the error that the solver may make.
  input = std::make_shared<const InputShapes>(input_shapes(
      own, [&](double t) { return points.at(t); }, options.time.step_s, steps(),
      1e-3 * options.solver.tolerance));
}

void Simulator::Impl::prepare() {
  report = std::exchange(prepared, {});
  need_region();
  if (options.region.measured == Measured::all) return;  // nothing is simulated
  run_together({[&] { need_boundary(); }, [&] { need_assembler(); }});
  const bool holds = by_forces() && !(load && load->patch_forces);
  if (options.model.strain == Strain::finite && holds) need_reduced();
  if (options.model.strain == Strain::linear)
    options.solver.method == SolverMethod::direct ? need_full() : need_reduced();
  if (options.drive.by == DriveBy::muscles && !load) need_muscles();
  prepared = report;
}

}  // namespace hyperex::simulate
