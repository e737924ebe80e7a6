// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "hyperex/core/version.hpp"

namespace hyperex::ct {
namespace {
using Json = nlohmann::ordered_json;

double rounded(double value, double step = 0.01) {
  return std::round(value / step) * step + 0.0;
}

/// Rounded to `digits` decimal places, and written with no more; null where it is not finite.
Json number(double value, int digits = 2) {
  if (!std::isfinite(value)) return nullptr;
  return Json::parse(fmt::format("{:.{}f}", rounded(value, std::pow(10, -digits)), digits));
}

Json point_mm(const Vec3& p) {
  return {number(1e3 * p.x()), number(1e3 * p.y()), number(1e3 * p.z())};
}

Json surface_json(const TriMesh& mesh) {
  if (mesh.triangles.rows() == 0) return nullptr;
  const Vec3 low = mesh.points.colwise().minCoeff().transpose(),
             high = mesh.points.colwise().maxCoeff().transpose();
  return {{"vertices", mesh.points.rows()},
          {"triangles", mesh.triangles.rows()},
          {"low_mm", point_mm(low)},
          {"high_mm", point_mm(high)}};
}

Json series_json(const CtFace& face) {
  const Volume& volume = face.series.volume;
  const Vec3 spacing = 1e3 * volume.spacing_m();
  return {{"kind", face.series.kind},
          {"size", volume.size},
          {"spacing_mm", {number(spacing.x(), 4), number(spacing.y(), 4), number(spacing.z(), 4)}},
          {"gantry_tilt_deg", number(face.series.tilt_deg)},
          {"greatest_hu", number(face.greatest_hu, 0)},
          {"noise_hu", number(face.thresholds.noise_hu, 0)},
          {"metal_cm3", number(face.metal_cm3, 3)}};
}

Json thresholds_json(const Thresholds& t) {
  return {
      {"skin_hu", number(t.skin_hu, 1)},
      {"skin_from", t.skin_given ? "given" : "half-way between air and soft tissue"},
      {"bone_hu", number(t.bone_hu, 1)},
      {"bone_from", t.bone_given ? "given" : "half-way between the means of soft tissue and bone"},
      {"air_hu", number(t.air_hu, 0)},
      {"soft_tissue_hu", number(t.soft_hu, 0)}};
}

std::string how_bones(const CtFace& face) {
  if (face.own_bones) return "the user's own segmentation";
  if (!face.separated) return "threshold; the mandible was not separated";
  return face.seeded ? "threshold, and watershed from the user's points"
                     : "threshold, and watershed from the pieces at separation_hu";
}

Json regions_json(const Thickness& thickness) {
  Json out = Json::object();
  for (const RegionThickness& r : thickness_by_region(thickness))
    out[name_of(r.region)] = {{"vertices", r.count},
                              {"mean_mm", number(r.mean_mm)},
                              {"median_mm", number(r.median_mm)},
                              {"low_5_percent_mm", number(r.low_mm)},
                              {"high_95_percent_mm", number(r.high_mm)},
                              {"along_normal_mean_mm", number(r.normal_mean_mm)}};
  return out;
}

Json points_json(const FoundPoints& points) {
  Json out = Json::object();
  for (const auto& [name, at] : points.skin) out[name + "_mm"] = point_mm(at);
  if (points.bone_pogonion_m) out["bone_pogonion_mm"] = point_mm(*points.bone_pogonion_m);
  if (points.bone_menton_m) out["bone_menton_mm"] = point_mm(*points.bone_menton_m);
  return out;
}

}  // namespace

std::vector<RegionThickness> thickness_by_region(const Thickness& thickness) {
  std::vector<RegionThickness> out;
  for (const Region region : {Region::forehead, Region::nose, Region::cheek_right,
                              Region::cheek_left, Region::lips, Region::chin}) {
    std::vector<double> mm;
    double sum = 0, along = 0, met = 0;
    for (Eigen::Index v = 0; v < thickness.shortest_m.size(); ++v) {
      if (thickness.region[std::size_t(v)] != region || std::isnan(thickness.shortest_m[v]))
        continue;
      mm.push_back(1e3 * thickness.shortest_m[v]);
      sum += mm.back();
      if (!std::isnan(thickness.along_normal_m[v]))
        along += 1e3 * thickness.along_normal_m[v], ++met;
    }
    if (mm.empty()) continue;
    std::sort(mm.begin(), mm.end());
    const auto at = [&](double share) { return mm[std::size_t(share * double(mm.size() - 1))]; };
    out.push_back({region, mm.size(), sum / double(mm.size()), at(0.5), at(0.05), at(0.95),
                   met > 0 ? along / met : std::numeric_limits<double>::quiet_NaN()});
  }
  return out;
}

std::string summary_json(const CtFace& face, const std::vector<std::string>& files) {
  const Json summary = {
      {"program", "hyperex"},
      {"command", "ct"},
      {"version", std::string(version())},
      {"frame",
       "mm; +x to the subject's left, +y up, +z forward. DICOM's patient frame is (x, -z, y) of "
       "it"},
      {"series", series_json(face)},
      {"thresholds", thresholds_json(face.thresholds)},
      {"couch", {{"removed", face.body.couch}, {"volume_cm3", number(face.body.couch_cm3, 1)}}},
      {"air_inside_cm3", number(face.body.cavities_cm3, 1)},
      {"bones",
       {{"from", how_bones(face)},
        {"mandible_separated", face.separated},
        {"separation_hu", face.own_bones || !face.separated ? Json() : number(face.level_hu, 0)}}},
      {"surfaces",
       {{"skin", surface_json(face.skin)},
        {"skull", surface_json(face.bones.skull)},
        {"mandible", surface_json(face.bones.mandible)}}},
      {"thickness",
       {{"back_z_mm", number(1e3 * face.bounds.back_z_m)},
        {"chin_z_mm", number(1e3 * face.bounds.chin_z_m)},
        {"below_chin_y_mm", number(1e3 * face.bounds.chin_y_m)},
        {"rise_to_the_back", number(face.bounds.rise, 4)},
        {"most_mm", number(1e3 * kMostThickness_m, 0)},
        {"regions", regions_json(face.thickness)}}},
      {"points", points_json(face.points)},
      {"notes", face.notes},
      {"warnings", face.warnings},
      {"files", files}};
  return summary.dump(1) + "\n";
}

std::vector<std::string> summary_lines(const CtFace& face) {
  const Volume& volume = face.series.volume;
  const Vec3 spacing = 1e3 * volume.spacing_m();
  std::vector<std::string> out = {
      fmt::format("{}: {} x {} x {} values, {:.3g} x {:.3g} x {:.3g} mm", face.series.kind,
                  volume.size[0], volume.size[1], volume.size[2], spacing.x(), spacing.y(),
                  spacing.z()),
      fmt::format("skin at {:g} HU, bone at {:g} HU; noise {:.0f} HU", face.thresholds.skin_hu,
                  face.thresholds.bone_hu, face.thresholds.noise_hu),
      fmt::format("skin {}, skull {}, mandible {} triangles", face.skin.triangles.rows(),
                  face.bones.skull.triangles.rows(), face.bones.mandible.triangles.rows())};
  for (const RegionThickness& r : thickness_by_region(face.thickness))
    out.push_back(
        fmt::format("thickness, {:<9} {:5.1f} mm in the middle, 5 to 95 %: {:.1f} to {:.1f} mm",
                    name_of(r.region), r.median_mm, r.low_mm, r.high_mm));
  for (const auto& [name, at] : face.points.skin)
    out.push_back(fmt::format("{:<10} {:.1f}, {:.1f}, {:.1f} mm", name, 1e3 * at.x(), 1e3 * at.y(),
                              1e3 * at.z()));
  return out;
}

}  // namespace hyperex::ct
