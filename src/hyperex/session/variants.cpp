// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/variants.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <mutex>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/session/simulation_options.hpp"
#include "hyperex/session/symmetry_measures.hpp"

namespace hyperex::session {
namespace {

/// Simulators whose factors can be used again: as many as ran at a time.
class SpentSimulators {
 public:
  void give(std::shared_ptr<simulate::Simulator> spent) {
    if (!spent) return;
    const std::lock_guard lock(mutex_);
    spent_.push_back(std::move(spent));
  }
  std::shared_ptr<simulate::Simulator> take() {
    const std::lock_guard lock(mutex_);
    if (spent_.empty()) return nullptr;
    std::shared_ptr<simulate::Simulator> one = std::move(spent_.back());
    spent_.pop_back();
    return one;
  }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<simulate::Simulator>> spent_;
};

}  // namespace

std::vector<VariantRun> prepare_variants(const scene::Scene& scene, const Inputs& inputs,
                                         TissueFields& fields) {
  std::vector<VariantRun> runs;
  for (const scene::Variant& variant : scene.variants) {
    VariantRun run;
    run.scene = variant.scene;
    run.scene.title = variant.name;
    run.folder = variant.folder;
    run.scene.output.vtu = run.scene.output.vtu && run.scene.output.variants_vtu;
    run.scene.output.report = false;
    run.inputs = inputs_of_variant(variant.scene, inputs);
    run.field = fields.of(variant.scene, fmt::format("variant[{}].", runs.size()));
    runs.push_back(std::move(run));
  }
  return runs;
}

void simulate_variants(std::vector<VariantRun>& runs, const simulate::Simulator& base,
                       const MirroredTwin& base_twin, const metrics::RestAsymmetry& at_rest) {
  Progress progress("simulating variants", static_cast<long>(runs.size()));
  std::mutex telling;
  SpentSimulators spent;
  long done = 0;
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    VariantRun& run = runs[i];
    try {
      simulate::SimulationOptions options = simulation_options(run.scene, run.inputs);
      if (run.field) options.tissue.element = run.field->element;
      simulate::Simulator simulator = base;
      simulator.hold_load();
      if (const auto other = spent.take()) simulator.reuse_factor(std::move(*other));
      simulator.set_options(std::move(options));
      run.simulation = simulator.run();
      MirroredTwin twin =
          simulate_variants_twin(run.scene, run.inputs, run.field ? &*run.field : nullptr,
                                 at_rest.plane, simulator, base_twin);
      spent.give(std::move(twin.simulator));
      run.symmetry =
          symmetry_measures(run.scene, run.inputs, at_rest, run.simulation.performance, twin);
    } catch (const NumericalError& error) {
      throw NumericalError(fmt::format("variant {}: {}", run.scene.title, error.what()));
    }
    const std::lock_guard lock(telling);
    progress.update(++done);
  });
}

}  // namespace hyperex::session
