// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/surgery.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/metrics/soft_tissue_moves.hpp"
#include "hyperex/render/camera.hpp"
#include "hyperex/render/contact_sheet.hpp"
#include "hyperex/render/render.hpp"
#include "hyperex/run/backing_surfaces.hpp"
#include "hyperex/run/face_box.hpp"

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

/// The face before and after surgery, at rest and at the peak of base, from the front and in
/// profile.
void draw_surgery(const Results& base, const VariantRun& run, const std::filesystem::path& file) {
  const face::FaceFrame frame = face::face_frame(base.inputs.landmarks);
  const simulate::Performance &before = base.simulation.performance,
                              &after = run.simulation.performance;
  const std::array<std::size_t, 2> frames{0, std::size_t(before.peak_frame)};
  const auto skin_of = [&](const simulate::Performance& p, std::size_t f) {
    return TriMesh{
        frame.local_points(before.skin_rest.points + p.skin_displacement_m[f].cast<double>()),
        before.skin_rest.triangles};
  };
  const Points rest = frame.local_points(before.skin_rest.points);
  const FaceBox box = face_box(base.inputs.landmarks, frame);
  std::vector<Vec3> seen;
  for (const std::size_t f : frames)
    for (const simulate::Performance* p : {&before, &after}) {
      const TriMesh skin = skin_of(*p, f);
      for (Eigen::Index v = 0; v < rest.rows(); ++v)
        if (box.holds(rest.row(v))) seen.emplace_back(skin.points.row(v));
    }
  Points framed(Eigen::Index(seen.size()), 3);
  for (std::size_t i = 0; i < seen.size(); ++i) framed.row(Eigen::Index(i)) = seen[i].transpose();

  const render::RenderOptions size{.width_px = 300, .height_px = 380};
  const double aspect = double(size.width_px) / size.height_px;
  std::array cameras{render::framing(framed, render::front_view(), aspect),
                     render::framing(framed, Vec3::UnitX(), aspect)};
  cameras[0].height_m = cameras[1].height_m = std::max(cameras[0].height_m, cameras[1].height_m);
  const report::FaceBacking backing =
      backing_in_frame(before.skin_rest, base.inputs.landmarks, base.teeth, frame);
  render::ContactSheet sheet;
  sheet.title = run.scene.title;
  sheet.note = fmt::format("before and after surgery: at rest, and at {:.2f} s",
                           before.frame_time_s[frames[1]]);
  sheet.columns = 4;
  sheet.pictures.resize(8);
  run_each(sheet.pictures.size(), [&](std::size_t at) {
    const std::size_t row = at / 4, view = at % 4 / 2, face = at % 2;
    const simulate::Performance& p = face == 0 ? before : after;
    const TriMesh skin = skin_of(p, frames[row]);
    const BackingSurfaces behind(backing, frame, skin.points, base.teeth,
                                 p.jaw_now_from_rest[frames[row]], p.upper_teeth_now_from_rest);
    sheet.pictures[at] = {
        render::render(behind.with({.mesh = skin}), cameras[view], size),
        fmt::format("{}, {}", face == 0 ? "before" : "after", row == 0 ? "at rest" : "expression"),
        render::side_marks(cameras[view])};
  });
  render::write_png(file, render::contact_sheet(sheet));
}

}  // namespace

bool changes_rest(const Results& base, const VariantRun& run) {
  return run.scene.surgery.bones != base.scene.surgery.bones ||
         volumes_of(run.scene) != volumes_of(base.scene);
}

void write_surgery(const Results& base, const VariantRun& run,
                   const std::filesystem::path& directory) {
  metrics::write_soft_tissue_csv(directory / "surgery.csv", moves_of(base, run));
  draw_surgery(base, run, directory / "surgery.png");
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
  constexpr std::array<std::pair<const char*, const char*>, 5> kShown = {
      {{"pogonion", "chin"},
       {"labiale_inferius", "lower lip"},
       {"labiale_superius", "upper lip"},
       {"subnasale", "base of the nose"},
       {"pronasale", "tip of the nose"}}};
  std::string text;
  for (const auto& [name, words] : kShown)
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
