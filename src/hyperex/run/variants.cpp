// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/variants.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <memory>
#include <mutex>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/metrics/variant_tables.hpp"
#include "hyperex/run/variants_picture.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/session/simulation_options.hpp"

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

/// Simulators that are not needed any more: as many as ran at a time. Their factors are.
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

void write_tables(const Results& base, const std::vector<VariantRun>& runs,
                  const metrics::VariantComparison& own,
                  const std::vector<metrics::VariantComparison>& compared,
                  const metrics::ResponsePair& pair, const fs::path& directory) {
  metrics::write_variants_csv(directory / "variants.csv", own, compared, pair);
  std::vector<metrics::NamedExcursions> excursions;
  for (const VariantRun& run : runs)
    excursions.push_back({run.scene.title, run.symmetry.excursions});
  metrics::write_variant_excursions_csv(directory / "variants_excursions.csv",
                                        base.symmetry.excursions, excursions);
}

}  // namespace

std::vector<VariantRun> prepare_variants(const scene::Scene& scene, const session::Inputs& inputs,
                                         session::TissueFields& fields) {
  std::vector<VariantRun> runs;
  for (const scene::Variant& variant : scene.variants) {
    VariantRun run;
    run.scene = variant.scene;
    run.scene.title = variant.name;
    run.folder = variant.folder;
    run.scene.output.vtu = run.scene.output.vtu && run.scene.output.variants_vtu;
    run.scene.output.report = false;
    run.inputs = session::inputs_of_variant(variant.scene, inputs);
    run.field = fields.of(variant.scene, fmt::format("variant[{}].", runs.size()));
    runs.push_back(std::move(run));
  }
  return runs;
}

void simulate_variants(std::vector<VariantRun>& runs, const simulate::Simulator& base,
                       const session::MirroredTwin& base_twin,
                       const metrics::RestAsymmetry& at_rest) {
  Progress progress("simulating variants", static_cast<long>(runs.size()));
  std::mutex telling;
  SpentSimulators spent;
  long done = 0;
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    VariantRun& run = runs[i];
    try {
      simulate::SimulationOptions options = session::simulation_options(run.scene, run.inputs);
      if (run.field) options.tissue.element = run.field->element;
      simulate::Simulator simulator = base;
      simulator.hold_load();
      if (const auto other = spent.take()) simulator.reuse_factor(std::move(*other));
      simulator.set_options(std::move(options));
      run.simulation = simulator.run();
      session::MirroredTwin twin =
          session::simulate_variants_twin(run.scene, run.inputs, run.field ? &*run.field : nullptr,
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

std::vector<std::string> lips_that_pass(const std::vector<VariantRun>& runs, double base_mm) {
  constexpr double kAsBase_mm = 0.1;
  std::vector<std::string> notes;
  for (const VariantRun& run : runs)
    if (const double mm = run.simulation.report.lip_overlap_mm;
        mm > kLipsPass_mm && (base_mm <= kLipsPass_mm || mm > base_mm + kAsBase_mm))
      notes.push_back(fmt::format(
          "variant {}: the lips pass through each other by up to {:.1f} mm ({:.1f} mm in base)",
          run.scene.title, mm, base_mm));
  return notes;
}

std::vector<std::string> gains_hardly_known(const simulate::MuscleCourse& base,
                                            const std::vector<VariantRun>& runs) {
  std::vector<std::string> notes;
  for (const VariantRun& run : runs) {
    const simulate::MuscleCourse& own = run.simulation.performance.muscles;
    if (own.names != base.names || own.activation.cols() != base.activation.cols()) continue;
    bool known = false;
    Eigen::Index most = -1, when = 0;
    for (Eigen::Index m = 0; m < base.activation.rows(); ++m) {
      if (own.activation.row(m) == base.activation.row(m)) continue;
      Eigen::Index at = 0;
      const double greatest = base.activation.row(m).cwiseAbs().maxCoeff(&at);
      known = known || greatest > base.sigma(m, at);
      if (most < 0 || greatest > std::abs(base.activation(most, when))) most = m, when = at;
    }
    if (most >= 0 && !known)
      notes.push_back(
          fmt::format("variant {}: in this recording {} is active by at most {:.2f} +- {:.2f} (1 "
                      "sigma), less than "
                      "its uncertainty, so that what its strength changes is hardly known; a "
                      "recording that uses it "
                      "more, such as a broad smile, or the whole branch of the nerve tells more",
                      run.scene.title, base.names[std::size_t(most)], base.activation(most, when),
                      base.sigma(most, when)));
  }
  return notes;
}

namespace {

struct Compared {
  metrics::ResponsePair pair;
  metrics::VariantComparison own;
  std::vector<metrics::VariantComparison> variants;
};

Compared compared_with(const Results& base, const std::vector<VariantRun>& runs) {
  const metrics::ComparedInputs inputs{base.inputs.landmarks, base.inputs.motion.motion};
  const metrics::ComparedRun own_run{base.simulation.performance, base.symmetry};
  Compared out;
  out.pair = metrics::response_pair(base.simulation.performance, base.inputs.motion.motion,
                                    2 * base.scene.drive.patch_radius_m);
  out.variants.resize(runs.size());
  tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
    out.variants[i] = metrics::compare_variant(runs[i].scene.title, own_run,
                                               {runs[i].simulation.performance, runs[i].symmetry},
                                               inputs, out.pair);
  });
  out.own = metrics::compare_variant("base", own_run, own_run, inputs, out.pair);
  return out;
}

Json table_of(const Results& base, const std::vector<VariantRun>& runs, const Compared& compared) {
  Json table = Json::array({metrics::json_of(compared.own)});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Json one = metrics::json_of(compared.variants[i]);
    one["folder"] = "variants/" + runs[i].folder;
    one["changes"] = scene::echoed_changes(base.scene, base.scene.variants[i].changes);
    one["lip_overlap_mm"] = runs[i].simulation.report.lip_overlap_mm;
    one["inverted_tets"] = runs[i].simulation.report.inverted_tets;
    one["excursions"] = metrics::summary_of(runs[i].symmetry).at("excursions");
    table.push_back(one);
  }
  return table;
}

}  // namespace

Json variant_table(const Results& base, const std::vector<VariantRun>& runs) {
  return table_of(base, runs, compared_with(base, runs));
}

Json write_variants(const Results& base, const std::vector<VariantRun>& runs,
                    const tissue::TissueMesh& mesh, const fs::path& directory) {
  Progress progress("writing variants", 0);
  const Compared compared = compared_with(base, runs);
  std::vector<std::optional<report::GlbReport>> glb(runs.size());
  run_together(
      {[&] { draw_variants(base, compared.variants, runs, directory / "variants.png"); },
       [&] { draw_variant_symmetry(base, runs, directory / "variants_symmetry.png"); },
       [&] { write_tables(base, runs, compared.own, compared.variants, compared.pair, directory); },
       [&] {
         tbb::parallel_for(std::size_t(0), runs.size(), [&](std::size_t i) {
           const VariantRun& run = runs[i];
           const Results results{run.scene,    run.inputs, mesh, run.simulation,
                                 run.symmetry, {},         {},   run.field ? &*run.field : nullptr,
                                 {},           base.teeth};
           const fs::path folder = directory / "variants" / run.folder;
           fs::create_directories(folder);
           glb[i] = write_outputs(results, folder, &base);
         });
       }});
  Json json;
  json["driven_point"] = compared.pair.driven;
  json["response_point"] = compared.pair.response;
  json["table"] = table_of(base, runs, compared);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (glb[i]) json["table"][i + 1]["glb"] = glb_json(*glb[i]);
  return json;
}

}  // namespace hyperex::run
