// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/variants.hpp"

#include <fmt/format.h>

#include <memory>
#include <mutex>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/metrics/variant_tables.hpp"
#include "hyperex/run/surgery.hpp"
#include "hyperex/run/variants_picture.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/simulate/load/held_load.hpp"

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

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

/// The subject's own sides on which a variant lets some muscle pull less than base does, "L" and
/// "R": a corner there that goes farther is dragged.
Json weaker_sides(const Results& base, const VariantRun& run) {
  const std::vector<std::string>& names = base.simulation.performance.muscles.names;
  const auto pull = [&](const scene::Scene& scene) -> Eigen::VectorXd {
    return scene.drive.gain *
           simulate::muscle_gains(names, scene.muscles.gains, base.scene.muscles.table());
  };
  const Eigen::VectorXd before = pull(base.scene), now = pull(run.scene);
  Json sides = Json::array();
  for (const char* side : {"R", "L"})
    for (std::size_t m = 0; m < names.size(); ++m)
      if (names[m].ends_with(std::string("_") + side) &&
          now[Eigen::Index(m)] < before[Eigen::Index(m)]) {
        sides.push_back(side);
        break;
      }
  return sides;
}

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
  run_each(runs.size(), [&](std::size_t i) {
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
    one["weaker_sides"] = weaker_sides(base, runs[i]);
    one["lip_overlap_mm"] = runs[i].simulation.report.lip_overlap_mm;
    one["inverted_tets"] = runs[i].simulation.report.inverted_tets;
    one["excursions"] = metrics::summary_of(runs[i].symmetry).at("excursions");
    if (changes_rest(base, runs[i])) one["surgery"] = surgery_json(base, runs[i]);
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
         run_each(runs.size(), [&](std::size_t i) {
           const VariantRun& run = runs[i];
           const Results results{run.scene,    run.inputs, mesh, run.simulation,
                                 run.symmetry, {},         {},   run.field ? &*run.field : nullptr,
                                 base.teeth};
           const fs::path folder = directory / "variants" / run.folder;
           fs::create_directories(folder);
           glb[i] = write_outputs(results, folder, &base);
           if (changes_rest(base, run)) write_surgery(base, run, folder);
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
