// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/surgery.hpp"

#include <fmt/format.h>

#include <cmath>

#include "hyperex/metrics/soft_tissue_moves.hpp"
#include "hyperex/run/surgery_picture.hpp"

namespace hyperex::run {
namespace {

/// The regions that add volume, without what else they change.
std::vector<tissue::TissueRegion> volumes_of(const scene::Scene& scene) {
  std::vector<tissue::TissueRegion> out = scene.tissue.regions;
  std::erase_if(out, [](const tissue::TissueRegion& region) { return region.volume_m3 == 0; });
  for (tissue::TissueRegion& region : out) region.value = region.factor = {};
  return out;
}

std::vector<metrics::SoftTissueMove> moves_of(const Results& base, const VariantRun& run) {
  // Where base moves bones too, the face at rest differs by less than what the variant moves, and
  // no ratio is published for that, nor for bones and volume together.
  const bool bones_alone =
      base.scene.surgery.bones.empty() && volumes_of(run.scene) == volumes_of(base.scene);
  const std::vector<simulate::BoneMove> none;
  return metrics::soft_tissue_moves(base.simulation.performance, run.simulation.performance,
                                    base.inputs.landmarks,
                                    bones_alone ? run.scene.surgery.bones : none);
}

}  // namespace

bool changes_rest(const Results& base, const VariantRun& run) {
  return run.scene.surgery.bones != base.scene.surgery.bones ||
         volumes_of(run.scene) != volumes_of(base.scene);
}

void write_surgery(const Results& base, const VariantRun& run,
                   const std::filesystem::path& directory) {
  const std::vector<metrics::SoftTissueMove> moves = moves_of(base, run);
  metrics::write_soft_tissue_csv(directory / "surgery.csv", moves);
  draw_surgery(base, run, moves, directory / "surgery.png");
}

nlohmann::ordered_json surgery_json(const Results& base, const VariantRun& run) {
  nlohmann::ordered_json out{{"landmarks", metrics::json_of(moves_of(base, run))}};
  if (const double width =
          metrics::change_of_nose_width_mm(base.simulation.performance, run.simulation.performance);
      std::isfinite(width))
    out["nose_width_change_mm"] = width;
  out["moves_bones"] = run.scene.surgery.bones != base.scene.surgery.bones;
  if (volumes_of(run.scene) != volumes_of(base.scene))
    out["added_volume_ml"] = 1e6 * ((run.field ? run.field->added_volume_m3 : 0) -
                                    (base.tissue ? base.tissue->added_volume_m3 : 0));
  out["skin_volume_change_ml"] =
      metrics::change_of_volume_ml(base.simulation.performance, run.simulation.performance);
  out["greatest_at_rest_mm"] =
      metrics::greatest_change_at_rest_mm(base.simulation.performance, run.simulation.performance);
  return out;
}

namespace {

std::string volume_words(const nlohmann::ordered_json& surgery) {
  const double added = surgery["added_volume_ml"], shown = surgery["skin_volume_change_ml"];
  constexpr double kNone_ml = 0.005;
  if (std::abs(added) < kNone_ml)
    return fmt::format("volume is elsewhere; the skin moves by up to {:.1f} mm",
                       surgery["greatest_at_rest_mm"].get<double>());
  const std::string words =
      fmt::format("{:.2g} ml {}", std::abs(added), added < 0 ? "taken away" : "added");
  // Bones change the volume below the skin too.
  if (surgery["moves_bones"]) return words;
  return words + fmt::format(", of which {:.2g} ml show at the skin; it moves by up to {:.1f} mm",
                             added < 0 ? -shown : shown,
                             surgery["greatest_at_rest_mm"].get<double>());
}

std::string landmark_words(const nlohmann::ordered_json& surgery) {
  std::string text;
  for (const auto& [name, words] : kSurgeryLandmarks)
    for (const auto& one : surgery["landmarks"]) {
      if (one["landmark"] != name) continue;
      const std::vector<double> by = one["at_rest_mm"];
      text += fmt::format("{}{} {:.1f} mm", text.empty() ? "" : ", ", words,
                          std::hypot(by[0], by[1], by[2]));
      if (!one.contains("published")) continue;
      const double ratio = one["soft_per_bone"], low = one["published"]["low"],
                   high = one["published"]["high"];
      text += fmt::format(" ({:.2f} of the bone; published {:.2f} to {:.2f}{})", ratio, low, high,
                          ratio < low || ratio > high ? ": outside" : "");
    }
  return text;
}

}  // namespace

std::string surgery_lines(const nlohmann::ordered_json& summary) {
  std::string lines;
  if (!summary.contains("variants")) return lines;
  for (const auto& row : summary["variants"]["table"]) {
    if (!row.contains("surgery")) continue;
    const auto& surgery = row["surgery"];
    std::string words = surgery["moves_bones"] ? landmark_words(surgery) : "";
    if (surgery.contains("added_volume_ml"))
      words += (words.empty() ? "" : ", ") + volume_words(surgery);
    lines += fmt::format("  {}, at rest: {}\n", row["name"].get<std::string>(), words);
  }
  return lines;
}

}  // namespace hyperex::run
