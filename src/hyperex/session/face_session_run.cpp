// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of base and its variants, and how certain they are.
#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <numeric>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/core/stopwatch.hpp"
#include "hyperex/session/driven_points.hpp"
#include "hyperex/session/face_session_impl.hpp"
#include "hyperex/session/run_notes.hpp"
#include "hyperex/session/same_face.hpp"
#include "hyperex/session/spent_simulators.hpp"
#include "hyperex/session/symmetry_measures.hpp"

namespace hyperex::session {
namespace {

MirroredTwin no_twin() {
  MirroredTwin none;
  none.why_not = "no mirrored twin was run yet";
  return none;
}

/// A run with a progress bar, which also calls the caller's callbacks.
simulate::SimulationResult run_with_bar(simulate::Simulator& simulator,
                                        simulate::RunCallbacks callbacks) {
  constexpr long parts = 1000;
  Progress progress("simulating", parts);
  const auto also = callbacks.progress;
  callbacks.progress = [&](double share) {
    progress.update(static_cast<long>(share * parts));
    if (also) also(share);
  };
  return simulator.run(callbacks);
}

}  // namespace

simulate::Simulator& FaceSession::Impl::simulator_of(std::size_t number) {
  if (number == 0) return *simulator;
  std::optional<simulate::Simulator>& own = states.at(number - 1).simulator;
  if (!own) {
    if (!next_variant) simulator->still(0);  // finds the forces, where there are none yet
    simulate::Simulator made = next_variant ? std::move(*next_variant) : *simulator;
    next_variant.reset();
    made.hold_load();
    made.set_options(runs[number - 1].options);
    own = std::move(made);
  }
  return *own;
}

void FaceSession::Impl::add_gaze(simulate::Performance& performance) const {
  if (!inputs.gaze) return;
  performance.gaze.clear();
  for (const double time_s : performance.frame_time_s)
    performance.gaze.push_back(inputs.gaze->at(time_s));
}

void FaceSession::Impl::run_base(const simulate::RunCallbacks& callbacks) {
  if (!stale) return;
  begin_stage("simulating");
  twin.reset();
  base_notes.clear();
  if (with_runs()) {
    const simulate::Simulator before_run = *simulator;
    MirroredTwin made;
    run_together({[&] { simulation = run_with_bar(*simulator, callbacks); },
                  [&] {
                    made = simulate_twin(scene, inputs, field ? &*field : nullptr,
                                         face.at_rest.plane, before_run, callbacks.cancelled);
                  }});
    twin = std::move(made);
  } else {
    simulation = run_with_bar(*simulator, callbacks);
  }
  add_gaze(simulation.performance);
  backing.reset();
  if (!simulation.performance.gaze.empty())
    backing = report::face_backing(simulation.performance, teeth.get());
  Progress measuring("measuring", 0);
  symmetry = symmetry_measures(scene, inputs, face.at_rest, simulation.performance,
                               twin ? *twin : no_twin());
  tissue_at_peak.reset();
  uncertainty.reset();
  stale = false;
  // At finite strain the run completed the load (what holds the patches): copies made before it
  // lack that.
  if (scene.model.strain == simulate::Strain::finite)
    for (VariantState& state : states) state = {};
  note_base();
}

const metrics::PeakTissue& FaceSession::Impl::peak() const {
  if (!tissue_at_peak) tissue_at_peak = metrics::peak_tissue(simulation.performance);
  return *tissue_at_peak;
}

const metrics::SkinUncertainty* FaceSession::Impl::skin_uncertainty() const {
  const simulate::Performance& performance = simulation.performance;
  if (performance.muscles.names.empty() || !scene.muscles.shape_prior) return nullptr;
  if (!uncertainty)
    uncertainty = metrics::skin_uncertainty(performance, *face.mesh, inputs.landmarks);
  return &*uncertainty;
}

void FaceSession::Impl::run_variants(const simulate::RunCallbacks& callbacks) {
  std::vector<std::size_t> due;
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (states[i].stale) due.push_back(i);
  if (due.empty()) return;
  Stopwatch watch;
  if (with_runs())
    run_variants_together(due, callbacks.cancelled);
  else
    for (const std::size_t i : due) run_variant(i, callbacks);
  seconds.variants = watch.lap();
  variant_notes = variant_warnings(simulation, runs);
  report(variant_notes);
}

/// All at once, each with its twin. Their simulators are not kept: their factors are used again.
void FaceSession::Impl::run_variants_together(const std::vector<std::size_t>& which,
                                              const std::function<bool()>& cancelled) {
  constexpr long parts = 1000;
  constexpr double own_share = 0.6;  // of a variant's time; its twin takes the rest
  Progress progress("simulating variants", parts * static_cast<long>(which.size()));
  std::mutex reporting;
  SpentSimulators spent;
  std::vector<double> done(which.size(), 0);
  const auto reached = [&](std::size_t w, double share) {
    const std::lock_guard lock(reporting);
    done[w] = share;
    progress.update(static_cast<long>(parts * std::accumulate(done.begin(), done.end(), 0.0)));
  };
  run_each(which.size(), [&](std::size_t w) {
    VariantRun& run = runs[which[w]];
    try {
      simulate::Simulator own = *simulator;
      own.hold_load();
      if (const auto other = spent.take()) own.reuse_factor(std::move(*other));
      own.set_options(run.options);
      run.simulation = own.run({.progress = [&](double share) { reached(w, own_share * share); },
                                .cancelled = cancelled});
      add_gaze(run.simulation.performance);
      MirroredTwin its_twin =
          simulate_variants_twin(run.scene, run.inputs, run.field ? &*run.field : nullptr,
                                 face.at_rest.plane, own, *twin, cancelled);
      spent.give(std::move(its_twin.simulator));
      run.symmetry = symmetry_measures(run.scene, run.inputs, face.at_rest,
                                       run.simulation.performance, its_twin);
    } catch (const NumericalError& error) {
      throw NumericalError(fmt::format("variant {}: {}", run.scene.title, error.what()));
    }
    reached(w, 1);
    const std::lock_guard lock(reporting);
    states[which[w]].stale = false;
    states[which[w]].has_bands = true;
  });
}

/// One, whose simulator is kept for the next change.
void FaceSession::Impl::run_variant(std::size_t i, const simulate::RunCallbacks& callbacks) {
  VariantRun& run = runs[i];
  run.simulation = simulator_of(i + 1).run(callbacks);
  add_gaze(run.simulation.performance);
  run.symmetry =
      symmetry_measures(run.scene, run.inputs, face.at_rest, run.simulation.performance, no_twin());
  states[i].stale = states[i].has_bands = false;
}

bool FaceSession::Impl::up_to_date() const {
  return !stale && std::none_of(states.begin(), states.end(),
                                [](const VariantState& state) { return state.stale; });
}

void FaceSession::Impl::find_bands(const std::function<bool()>& cancelled) {
  const metrics::MidsagittalPlane& plane = face.at_rest.plane;
  if (!twin) {
    twin = simulate_twin(scene, inputs, field ? &*field : nullptr, plane, *simulator, cancelled);
    symmetry = symmetry_measures(scene, inputs, face.at_rest, simulation.performance, *twin);
    twin->skin_displacement_m.clear();
    note_base();
  }
  for (std::size_t i = 0; i < runs.size(); ++i) {
    if (states[i].has_bands) continue;
    VariantRun& run = runs[i];
    simulate::Simulator spent = simulator_of(i + 1);
    const MirroredTwin its_twin = simulate_variants_twin(
        run.scene, run.inputs, run.field ? &*run.field : nullptr, plane, spent, *twin, cancelled);
    run.symmetry = symmetry_measures(run.scene, run.inputs, face.at_rest,
                                     run.simulation.performance, its_twin);
    states[i].has_bands = true;
  }
}

FaceResult FaceSession::Impl::result(std::size_t number) const {
  const VariantRun* run = number == 0 ? nullptr : &runs.at(number - 1);
  FaceResult out;
  out.name = run ? run->scene.title : "base";
  out.simulation =
      std::make_shared<const simulate::SimulationResult>(run ? run->simulation : simulation);
  out.symmetry = std::make_shared<const metrics::SymmetryMeasures>(run ? run->symmetry : symmetry);
  out.scan = std::make_shared<const io::Scan>(inputs.scan);
  out.teeth = teeth;
  out.notes = notes();
  return out;
}

void FaceSession::Impl::prepare_variant() {
  // At finite strain the run of base itself completes what a variant keeps.
  if (!runs.empty() || next_variant || scene.model.strain == simulate::Strain::finite) return;
  next_variant = *simulator;
  next_variant->hold_load();
  next_variant->still(0);
}

/// The face that run() returns: the one that set() changed, else base.
std::size_t FaceSession::Impl::changed_face() const {
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].scene.title == kChanged) return i + 1;
  return 0;
}

void FaceSession::Impl::take_source(SceneSource next) {
  take(next.scene());
  set_obstacles();
  source = std::move(next);
  note_tissue();
}

// ----- the class

FaceResult FaceSession::run(const simulate::RunCallbacks& callbacks) {
  run_base(callbacks);
  run_variants(callbacks);
  return result(impl_->changed_face());
}

void FaceSession::set(const std::string& key, const Value& value) {
  SceneSource next = is_variant_key(key) ? impl_->source.with_change(kChanged, key, value)
                                         : impl_->source.with_value(key, value);
  if (same_face(impl_->scene, next.scene()))
    impl_->take_source(std::move(next));
  else
    impl_ = std::make_unique<Impl>(std::move(next), impl_->session_options);
}

FaceResult FaceSession::variant(const std::string& name, const Changes& changes,
                                const simulate::RunCallbacks& callbacks) {
  impl_->take_source(impl_->source.with_variant(name, changes));
  run_base(callbacks);
  run_variants(callbacks);
  std::size_t face = 1;
  while (variants().at(face - 1).scene.title != name) ++face;
  return result(face);
}

const simulate::Performance& FaceSession::performance() {
  run_base();
  run_variants();
  const std::size_t face = impl_->changed_face();
  return face == 0 ? simulation().performance : variants()[face - 1].simulation.performance;
}

const metrics::SymmetryMeasures& FaceSession::measures() {
  run_base();
  run_variants();
  const std::size_t face = impl_->changed_face();
  return face == 0 ? symmetry() : variants()[face - 1].symmetry;
}

void FaceSession::run_base(const simulate::RunCallbacks& callbacks) {
  impl_->run_base(callbacks);
}
void FaceSession::run_variants(const simulate::RunCallbacks& callbacks) {
  impl_->run_variants(callbacks);
}
bool FaceSession::base_up_to_date() const {
  return !impl_->stale;
}
bool FaceSession::up_to_date() const {
  return impl_->up_to_date();
}
FaceResult FaceSession::result(std::size_t face) const {
  return impl_->result(face);
}

bool FaceSession::certainty_known() const {
  const auto& states = impl_->states;
  return impl_->up_to_date() && impl_->twin && impl_->searched &&
         std::all_of(states.begin(), states.end(), [](const auto& one) { return one.has_bands; });
}

void FaceSession::find_certainty(const std::function<bool()>& cancelled) {
  impl_->find_bands(cancelled);
  impl_->begin_search();
  impl_->finish_search();
}

PointsF FaceSession::still(std::size_t face, double time_s) {
  return impl_->simulator_of(face).still(time_s);
}

void FaceSession::prepare_variant() {
  impl_->prepare_variant();
}

bool FaceSession::ready(std::size_t face) const {
  return face == 0 || impl_->next_variant || impl_->states.at(face - 1).simulator;
}

}  // namespace hyperex::session
