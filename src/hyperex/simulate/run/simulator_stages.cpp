// SPDX-License-Identifier: GPL-3.0-or-later
// How the stages are computed. What each may read is declared in simulator_stages.hpp.
#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/simulate/load/added_volume.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/load/muscle_prior.hpp"
#include "hyperex/simulate/run/simulator_impl.hpp"

namespace hyperex::simulate {
namespace {

TissueValues without_volume(TissueValues tissue) {
  tissue.volume_ratio.clear();
  return tissue;
}

}  // namespace

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

bool Simulator::Impl::by_forces() const {
  return options.drive.by != DriveBy::displacement;
}

void Simulator::Impl::ensure_skin() {
  stages.points.ensure([&] {
    return std::make_shared<const DrivenPoints>(*mesh, *landmarks, *motion,
                                                options.drive.names_in(motion->motion));
  });
  stages.readout.ensure([&] { return std::make_shared<const Readout>(*mesh, *landmarks); });
  stages.measured.ensure([&] {
    return std::make_shared<const MeasuredRegion>(
        measured_region(*mesh, *landmarks, *motion, options.region));
  });
}

void Simulator::Impl::ensure_boundary() {
  if (options.drive.by == DriveBy::muscles) {
    stages.boundary.ensure([&] {
      return std::make_shared<const Boundary>(*mesh, *landmarks,
                                              muscle_support(options.support, options.muscles));
    });
  } else {
    stages.driven.ensure([&] {
      return std::make_shared<const DrivenSkin>(
          driven_skin(*mesh, *landmarks, *motion, stages.measured.value(), options.drive));
    });
    stages.boundary.ensure([&] {
      const Boundary whole(*mesh, *landmarks, *motion, stages.driven.pointer(), options.support);
      return std::make_shared<const Boundary>(by_forces() ? whole.released() : whole);
    });
  }
  ensure_moved_bones();
  stages.prescribed.set(stages.boundary->prescribed());
  stages.values.ensure([&] {
    return std::make_shared<const MatrixValues>(
        MatrixValues{without_volume(options.tissue), options.model, options.drive.by,
                     as_recorded(options.muscles), stages.boundary.pointer()});
  });
}

void Simulator::Impl::ensure_moved_bones() {
  stages.moved_bones.ensure([&] {
    auto out = std::make_shared<MovedBones>();
    out->prescribed.setZero(Eigen::Index(stages.boundary->prescribed().size()));
    out->force.setZero(3 * mesh->volume.nodes.rows());
    if (options.surgery.bones.empty()) return std::shared_ptr<const MovedBones>(std::move(out));
    const Osteotomies cuts(options.surgery.bones, *landmarks, mesh->bones.get());
    const Boundary moved = stages.boundary->with_moved_bones(*landmarks, cuts);
    out->any = true;
    out->prescribed = moved.prescribed_by_bones();
    out->force = moved.forces_of_bones();
    out->jaw_force_change = moved.unit_forces_of_jaw() - stages.boundary->unit_forces_of_jaw();
    out->upper_teeth = cuts.upper_teeth();
    out->lower_teeth = cuts.lower_teeth();
    return std::shared_ptr<const MovedBones>(std::move(out));
  });
}

void Simulator::Impl::ensure_added_volume() {
  stages.added_volume.ensure([&] {
    AddedVolume out;
    if (!options.tissue.volume_ratio.empty()) {
      out.growth = growth_through_layer(mesh->volume, options.tissue.volume_ratio);
      out.force = stages.pattern->growth_force(material(), out.growth);
      if (options.model.strain == Strain::finite)
        out.grown = std::make_shared<const fem::Assembler>(stages.pattern->grown(out.growth));
    }
    return std::make_shared<const AddedVolume>(std::move(out));
  });
}

const fem::Assembler& Simulator::Impl::grown_pattern() {
  ensure_added_volume();
  return stages.added_volume->grown ? *stages.added_volume->grown : stages.pattern.value();
}

bool Simulator::Impl::changes_rest() const {
  return stages.moved_bones->any || !options.tissue.volume_ratio.empty();
}

HeldLoad Simulator::Impl::on_moved_bones(HeldLoad load) const {
  if (options.drive.by == DriveBy::muscles && stages.moved_bones->any)
    load.force.middleCols<12>(jaw_row(load)) += stages.moved_bones->jaw_force_change;
  return load;
}

Eigen::VectorXd Simulator::Impl::neutral_at_small_strain() {
  if (!changes_rest()) return {};
  ensure_factor();
  ensure_added_volume();
  const MovedBones& moved = stages.moved_bones.value();
  fem::Drive once;
  once.prescribed = moved.prescribed;
  once.force = moved.force;
  if (!stages.added_volume->growth.empty()) once.force += stages.added_volume->force;
  once.s = Eigen::MatrixXd::Ones(1, 1);
  once.rate = once.second = Eigen::MatrixXd::Zero(1, 1);
  return stages.factor->model.at_rest(once, {0});
}

void Simulator::Impl::ensure_pattern() {
  stages.pattern.ensure([&] {
    return std::make_shared<const fem::Assembler>(mesh->volume.nodes, mesh->volume.tets,
                                                  options.model.element);
  });
}

fem::Material Simulator::Impl::material() const {
  fem::Material out = options.tissue.material(static_cast<std::size_t>(mesh->volume.tets.rows()),
                                              options.model.viscous_form);
  if (options.drive.by == DriveBy::muscles) stiffen_lips(*mesh, *landmarks, options.muscles, out);
  return out;
}

fem::NewmarkOptions Simulator::Impl::newmark() const {
  return {options.time.step_s, options.solver.newmark_beta, options.solver.newmark_gamma};
}

void Simulator::Impl::fill(fem::System& system) {
  Stopwatch watch;
  stages.pattern->assemble(material(), system);
  stages.values->boundary->add_springs(system.stiffness);
  report.assemble_s += watch.lap();
}

std::shared_ptr<const fem::NodeOrder> Simulator::Impl::known_order() const {
  const auto& order = stages.order.pointer();
  return order ? order->nodes : nullptr;
}

void Simulator::Impl::keep_order(const std::shared_ptr<const fem::NodeOrder>& nodes) {
  stages.order.keep(
      std::make_shared<const EliminationOrder>(EliminationOrder{stages.prescribed.value(), nodes}));
}

template <class Model>
void Simulator::Impl::report_factor(const Model& model) {
  report.analyse_s += model.analyse_seconds();
  report.factor_s += model.factor_seconds();
  keep_order(model.order());
}

void Simulator::Impl::ensure_factor() {
  stages.factor.ensure(
      [&] {
        fem::System system;
        fill(system);
        fem::ReducedModel model(std::move(system), stages.prescribed.value(), known_order());
        report_factor(model);
        return ReducedFactor{std::move(model), stages.values.pointer()};
      },
      [&](ReducedFactor& factor) {
        // A mirrored twin often has the very matrices of the run whose factor it takes.
        if (factor.of && *factor.of == stages.values.value()) return;
        factor.of.reset();
        fem::System system = factor.model.release();
        fill(system);
        factor.model.refill(std::move(system));
        report.factor_s += factor.model.factor_seconds();
        factor.of = stages.values.pointer();
      });
}

void Simulator::Impl::ensure_full_model() {
  stages.full.ensure(
      [&] {
        fem::System system;
        fill(system);
        fem::Newmark model(std::move(system), stages.prescribed.value(), newmark(), known_order());
        report_factor(model);
        return model;
      },
      [&](fem::Newmark& model) {
        fem::System system;
        fill(system);
        model.refill(std::move(system));
        report.factor_s += model.factor_seconds();
      });
}

void Simulator::Impl::ensure_muscle_model() {
  stages.muscle_model.ensure([&] {
    fem::System system;
    stages.pattern->assemble(material(), system);
    return std::make_shared<const MuscleModel>(
        muscle_model(*mesh, *landmarks, options, system.stiffness, known_order(),
                     [this] { progress.report_towards(kReducedDone); }));
  });
  keep_order(stages.muscle_model->order());
}

HeldLoad Simulator::Impl::reaction_load(const PointCurve& points) {
  fem::System system;
  stages.pattern->assemble(material(), system);
  Boundary whole(*mesh, *landmarks, *motion, stages.driven.pointer(), options.support);
  whole.add_springs(system.stiffness);
  const InputShapes shapes = input_shapes(
      whole, [&](double t) { return points.at(t); }, options.time.step_s, steps(),
      1e-3 * options.solver.tolerance);
  HeldLoad found =
      reactions_of(shapes.drive, system.stiffness, whole.prescribed(), options.time.step_s);
  found.greatest_opening_deg = shapes.greatest_opening_deg;
  return found;
}

void Simulator::Impl::check_no_region_is_measured() const {
  if (options.region.measured != Measured::none)
    throw InputError("drive.by",
                     "forces cannot drive a face of which a region follows the recording "
                     "(region.measured): expected drive.by = \"displacement\"");
}

void Simulator::Impl::check_load_lasts() const {
  if (const double until_s = stages.load->until_s; until_s < end_s() - 1e-9)
    throw InputError("time.end_s",
                     fmt::format("{:g} s: the held forces are those of a run of {:g} s; expected "
                                 "no more",
                                 end_s(), until_s));
}

void Simulator::Impl::ensure_load(const PointCurve& points) {
  if (!by_forces()) return;
  if (stages.load.has_value()) return check_load_lasts();
  check_no_region_is_measured();
  const bool muscles = options.drive.by == DriveBy::muscles;
  if (muscles) ensure_muscle_model();
  const auto samples = double(samples_of_run(motion->motion.time_s, options.time));
  double fitted = 0;
  const auto sample_fitted = [&] {
    progress.report(std::max(progress.done(), kLoadDone * std::min(1.0, ++fitted / samples)));
  };
  stages.load.ensure([&] {
    return std::make_shared<const HeldLoad>(
        muscles ? muscle_load(*mesh, *landmarks, *motion, stages.measured.value(), options,
                              stages.muscle_model.value(), sample_fitted)
                : reaction_load(points));
  });
  if (stages.answered.has_value()) {
    report.forces_found_anew = true;
    warn("forces.found_anew", "", kForcesFoundAnew);
  }
  stages.answered.keep(std::make_shared<const bool>(true));
}

fem::Drive Simulator::Impl::drive_by(const HeldLoad& forces, const MuscleOptions& muscles) const {
  return drive_of(forces, muscles, options.time.step_s, steps(), 1e-3 * options.solver.tolerance,
                  static_cast<Eigen::Index>(stages.boundary->prescribed().size()));
}

void Simulator::Impl::ensure_input(const PointCurve& points) {
  if (stages.input.has_value()) return;
  ensure_load(points);
  stages.input.ensure([&] {
    if (by_forces())
      return std::make_shared<const InputShapes>(
          InputShapes{drive_by(on_moved_bones(stages.load.value()), options.muscles),
                      greatest_opening_deg(stages.load.value(), end_s())});
    // A boundary follows the jaw from its last position on: a copy begins at rest.
    Boundary own = stages.boundary.value();
    // The error of the compressed input must be negligible compared with the solver's tolerance.
    return std::make_shared<const InputShapes>(input_shapes(
        own, [&](double t) { return points.at(t); }, options.time.step_s, steps(),
        1e-3 * options.solver.tolerance));
  });
}

void Simulator::Impl::check_before_run() {
  ensure_skin();
  if (options.region.measured == Measured::all) return;  // nothing is simulated
  if (by_forces()) check_no_region_is_measured();
  const ChosenPoints chosen = chosen_points(*landmarks, *motion, options.drive);
  check_on_skin(chosen.points, mesh->skin, motion->motion.source);
  if (options.drive.by == DriveBy::muscles)
    muscle_prior(muscles::muscle_lines(options.muscles.table(), *mesh, *landmarks),
                 options.muscles);
  else
    needed_jaw_rows(*motion, chosen.rows, options.support);
  steps();
}

void Simulator::Impl::prepare() {
  report = std::exchange(prepared, {});
  ensure_skin();
  if (options.region.measured == Measured::all) return;  // nothing is simulated
  run_together({[&] { ensure_boundary(); }, [&] { ensure_pattern(); }});
  const bool holds_patches = by_forces() && !(stages.load.has_value() && stages.load->patch_forces);
  if (options.model.strain == Strain::finite && holds_patches) ensure_factor();
  if (options.model.strain == Strain::linear)
    options.solver.method == SolverMethod::direct ? ensure_full_model() : ensure_factor();
  if (options.drive.by == DriveBy::muscles && !stages.load.has_value()) ensure_muscle_model();
  prepared = report;
}

}  // namespace hyperex::simulate
