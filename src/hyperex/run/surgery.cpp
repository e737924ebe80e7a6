// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/surgery.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "hyperex/core/run_together.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/geometry/plane_section.hpp"
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

/// The landmarks that pictures and printed lines name.
constexpr std::array<std::pair<const char*, const char*>, 5> kNamed = {
    {{"pogonion", "chin"},
     {"labiale_inferius", "lower lip"},
     {"labiale_superius", "upper lip"},
     {"subnasale", "base of the nose"},
     {"pronasale", "tip of the nose"}}};

/// What the pictures of surgery share: the skin in the face frame.
struct BeforeAndAfter {
  const Results& base;
  const simulate::Performance &before, &after;
  face::FaceFrame frame = face::face_frame(base.inputs.landmarks);
  FaceBox box = face_box(base.inputs.landmarks, frame);
  std::array<std::size_t, 2> frames{0, std::size_t(before.peak_frame)};  ///< rest, expression

  TriMesh skin(const simulate::Performance& of, std::size_t at) const {
    return {frame.local_points(before.skin_rest.points + of.skin_displacement_m[at].cast<double>()),
            before.skin_rest.triangles};
  }
};

constexpr render::RenderOptions kSize{.width_px = 300, .height_px = 380};
constexpr render::Colour kBefore = render::palette::faint_ink, kAfter = render::palette::driven;

/// From the front and in profile, at the same scale.
std::array<render::Camera, 2> cameras_on(const BeforeAndAfter& both) {
  const Points rest = both.frame.local_points(both.before.skin_rest.points);
  std::vector<Vec3> seen;
  for (const std::size_t f : both.frames)
    for (const simulate::Performance* p : {&both.before, &both.after}) {
      const TriMesh skin = both.skin(*p, f);
      for (Eigen::Index v = 0; v < rest.rows(); ++v)
        if (both.box.holds(rest.row(v))) seen.emplace_back(skin.points.row(v));
    }
  Points framed(Eigen::Index(seen.size()), 3);
  for (std::size_t i = 0; i < seen.size(); ++i) framed.row(Eigen::Index(i)) = seen[i].transpose();
  const double aspect = double(kSize.width_px) / kSize.height_px;
  std::array cameras{render::framing(framed, render::front_view(), aspect),
                     render::framing(framed, Vec3::UnitX(), aspect)};
  cameras[0].height_m = cameras[1].height_m = std::max(cameras[0].height_m, cameras[1].height_m);
  return cameras;
}

/// The midline of the skin at rest, before and after surgery, in profile, with the distance by
/// which surgery moves each landmark on it.
render::Image draw_midlines(const BeforeAndAfter& both, render::Camera profile,
                            const std::vector<metrics::SoftTissueMove>& moves) {
  constexpr double kText_px = 12, kLine_px = 15, kWords_px = 140;
  const double m_per_px = profile.height_m / kSize.height_px;
  const auto segments_of = [&](const simulate::Performance& of) {
    return plane_section(both.skin(of, 0), Vec3::Zero(), Vec3::UnitX());
  };
  const Points before = segments_of(both.before), after = segments_of(both.after);
  // The words stand before the face, on the left of the picture.
  const Points seen = points_within(both.box, after);
  const double front_m = seen.rows() > 0 ? seen.col(2).maxCoeff() : both.box.high.z();
  profile.target.z() = front_m - (0.5 * kSize.width_px - kWords_px) * m_per_px;
  render::Canvas canvas(kSize.width_px, kSize.height_px);
  const auto place = [&](const Vec3& p) {
    return render::project(profile, kSize.width_px, kSize.height_px, p);
  };
  for (const auto& [segments, colour] : {std::pair{&before, kBefore}, {&after, kAfter}})
    for (Eigen::Index i = 0; i + 1 < segments->rows(); i += 2) {
      const render::Projected a = place(segments->row(i)), b = place(segments->row(i + 1));
      canvas.line(a.x, a.y, b.x, b.y, colour, 1.6);
    }
  double free_below_px = kSize.height_px - 6;
  for (const auto& [name, words] : kNamed) {
    const auto move = std::find_if(moves.begin(), moves.end(),
                                   [&](const auto& one) { return one.landmark == name; });
    const int row = both.after.landmarks.index_of(name);
    if (move == moves.end() || row < 0) continue;
    const render::Projected at =
        place(both.frame.local(both.after.landmarks.positions[0].row(row).transpose()));
    const double y = std::min(at.y + kText_px / 3, free_below_px);
    const double width = canvas.text(6, y, fmt::format("{} {:.1f} mm", words, move->at_rest.norm()),
                                     {.size_px = kText_px});
    canvas.line(6 + width + 4, y - kText_px / 3, at.x, at.y, kBefore, 0.8);
    canvas.disc(at.x, at.y, 2.5, kAfter);
    free_below_px = y - kLine_px;
  }
  return canvas.image();
}

/// The face at rest from the front, coloured by how far surgery moves it.
render::SheetPicture draw_change_at_rest(const BeforeAndAfter& both, const render::Camera& front,
                                         const render::Range& range_mm,
                                         const BackingSurfaces& behind, const TriMesh& skin) {
  const PointsF change = both.after.skin_displacement_m[0] - both.before.skin_displacement_m[0];
  return {
      render::render(
          behind.with({.mesh = skin, .scalar = 1e3F * change.rowwise().norm(), .range = range_mm}),
          front, kSize),
      "change at rest", render::side_marks(front)};
}

/// Before and after surgery, at rest and at the peak of base, from the front and in profile; on the
/// right what changes at rest, in millimetres.
void draw_surgery(const Results& base, const VariantRun& run,
                  const std::vector<metrics::SoftTissueMove>& moves,
                  const std::filesystem::path& file) {
  const BeforeAndAfter both{base, base.simulation.performance, run.simulation.performance};
  const std::array cameras = cameras_on(both);
  const report::FaceBacking backing =
      backing_in_frame(both.before.skin_rest, base.inputs.landmarks, base.teeth, both.frame);
  const render::Range range_mm{
      0, std::max(0.1, metrics::greatest_change_at_rest_mm(both.before, both.after))};
  render::ContactSheet sheet;
  sheet.title = run.scene.title;
  sheet.note = fmt::format(
      "before and after surgery: at rest, and at {:.2f} s; lower right: the midline at rest, "
      "before "
      "(grey) and after (red)",
      both.before.frame_time_s[both.frames[1]]);
  sheet.columns = 5;
  sheet.bar = render::ColourBar{range_mm, "change (mm)"};
  sheet.pictures.resize(10);
  run_each(sheet.pictures.size(), [&](std::size_t cell) {
    const std::size_t row = cell / 5, view = cell % 5 / 2;
    const bool change = view == 2, later = change || cell % 5 % 2 == 1;
    if (change && row == 1) {
      sheet.pictures[cell] = {draw_midlines(both, cameras[1], moves), "the midline at rest"};
      return;
    }
    const simulate::Performance& p = later ? both.after : both.before;
    const TriMesh skin = both.skin(p, both.frames[row]);
    const BackingSurfaces behind(backing, both.frame, skin.points, base.teeth,
                                 p.jaw_now_from_rest[both.frames[row]],
                                 p.upper_teeth_now_from_rest);
    sheet.pictures[cell] =
        change ? draw_change_at_rest(both, cameras[0], range_mm, behind, skin)
               : render::SheetPicture{
                     render::render(behind.with({.mesh = skin}), cameras[view], kSize),
                     fmt::format("{}, {}", later ? "after" : "before",
                                 row == 0 ? "at rest" : "expression"),
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
  for (const auto& [name, words] : kNamed)
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
