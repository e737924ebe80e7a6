// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/variants.hpp"

#include <fmt/format.h>

#include <memory>
#include <mutex>
#include <utility>

#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/core/run_together.hpp"
#include "hyperex/metrics/symmetry_json.hpp"
#include "hyperex/metrics/variant_tables.hpp"
#include "hyperex/metrics/with_jaw.hpp"
#include "hyperex/run/surgery.hpp"
#include "hyperex/run/variants_picture.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/simulate/drive/jaw.hpp"
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

/// The factor of each muscle's pull in base and in a variant.
struct Pulls {
  std::vector<std::string> names;
  Eigen::VectorXd before, now;

  Pulls(const Results& base, const VariantRun& run)
      : names(base.simulation.performance.muscles.names),
        before(of(base.scene, base)),
        now(of(run.scene, base)) {}

  Eigen::VectorXd of(const scene::Scene& scene, const Results& base) const {
    return scene.drive.gain *
           simulate::muscle_gains(names, scene.muscles.gains, base.scene.muscles.table());
  }
  bool on_side(std::size_t muscle, const char* side) const {
    return names[muscle].ends_with(std::string("_") + side);
  }
};

/// The subject's own sides on which a variant lets some muscle pull less than base does, "L" and
/// "R": a corner there that goes farther is dragged.
Json weaker_sides(const Pulls& pulls) {
  Json sides = Json::array();
  for (const char* side : {"R", "L"})
    for (std::size_t m = 0; m < pulls.names.size(); ++m)
      if (pulls.on_side(m, side) && pulls.now[Eigen::Index(m)] < pulls.before[Eigen::Index(m)]) {
        sides.push_back(side);
        break;
      }
  return sides;
}

/// The sides on which no muscle pulls in a variant, although some do in base.
Json unpulled_sides(const Pulls& pulls) {
  Json sides = Json::array();
  for (const char* side : {"R", "L"}) {
    double before = 0, now = 0;
    for (std::size_t m = 0; m < pulls.names.size(); ++m)
      if (pulls.on_side(m, side)) {
        before += pulls.before[Eigen::Index(m)];
        now += pulls.now[Eigen::Index(m)];
      }
    if (before > 0 && now == 0) sides.push_back(side);
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

/// Adds how far the corners of the mouth would go if they were fixed to the jaw, and if that only
/// turned about its joints.
void add_jaw_part(const Results& base, const VariantRun& run, Json& row) {
  const simulate::Performance& p = run.simulation.performance;
  const metrics::Commissure& corners = run.symmetry.excursions.commissure;
  const simulate::JawHinge hinge(base.inputs.landmarks, base.mesh.bones.get());
  const auto turned = metrics::turned_about(p.jaw_now_from_rest, hinge.centre);
  for (const auto& [side, column] : {std::pair{"R", corners.right}, {"L", corners.left}}) {
    const std::string corner = std::string("commissure_") + side;
    row[corner + "_with_jaw_mm"] = metrics::with_jaw_mm(p.jaw_now_from_rest, p.landmarks, column);
    row[corner + "_with_turned_jaw_mm"] = metrics::with_jaw_mm(turned, p.landmarks, column);
  }
}

Json table_of(const Results& base, const std::vector<VariantRun>& runs, const Compared& compared) {
  Json table = Json::array({metrics::json_of(compared.own)});
  for (std::size_t i = 0; i < runs.size(); ++i) {
    Json one = metrics::json_of(compared.variants[i]);
    one["folder"] = "variants/" + runs[i].folder;
    one["changes"] = scene::echoed_changes(base.scene, base.scene.variants[i].changes);
    const Pulls pulls(base, runs[i]);
    one["weaker_sides"] = weaker_sides(pulls);
    one["unpulled_sides"] = unpulled_sides(pulls);
    add_jaw_part(base, runs[i], one);
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
