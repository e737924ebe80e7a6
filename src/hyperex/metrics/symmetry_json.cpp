// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry_json.hpp"

#include <cmath>

#include "hyperex/metrics/excursion_budget.hpp"
#include "hyperex/metrics/mesh_floor.hpp"
#include "hyperex/metrics/nan.hpp"

namespace hyperex::metrics {
namespace {
using Json = nlohmann::ordered_json;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json both(double left, double right) {
  return {{"R", number(right)}, {"L", number(left)}};
}

Json undecided_json(const std::optional<bool>& decided) {
  return decided ? Json(!*decided) : Json(nullptr);
}

Json floor_json(bool known, double floor) {
  return number(known ? floor : kNan);
}

Json pair_json(const PairExcursion& p) {
  Json json;
  json["point"] = p.name;
  json["recorded"] = {{"R", p.right_recorded}, {"L", p.left_recorded}};
  json["excursion_mm"] = both(p.left_side.excursion_mm, p.right_side.excursion_mm);
  json["excursion_ratio_R_L"] = number(p.excursion_ratio);
  json["path_mm"] = both(p.left_side.path_mm, p.right_side.path_mm);
  json["path_ratio_R_L"] = number(p.path_ratio);
  json["peak_speed_mm_s"] = both(p.left_side.peak_speed_mm_s, p.right_side.peak_speed_mm_s);
  json["peak_speed_ratio_R_L"] = number(p.speed_ratio);
  json["speed_correlation"] = number(p.speed_correlation);
  json["path_floor_mm"] = floor_json(p.known.jitter, p.path_floor_mm);
  json["path_undecided"] = undecided_json(p.decided(p.path_undecided));
  json["peak_speed_floor_mm_s"] = floor_json(p.known.jitter, p.peak_speed_floor_mm_s);
  json["peak_speed_undecided"] = undecided_json(p.decided(p.peak_speed_undecided));
  json["speed_correlation_undecided"] = undecided_json(p.decided(p.speed_correlation_undecided));
  json["difference_mm"] = number(p.difference_mm());
  json["jitter_floor_mm"] = floor_json(p.known.jitter, p.jitter_floor_mm);
  json["mesh_floor_mm"] = number(p.mesh_floor_mm);
  json["pose_floor_mm"] = floor_json(p.pose_floor_known(), p.pose_floor_mm);
  json["repetition_floor_mm"] = p.repetition_floor_mm;
  json["floor_mm"] = floor_json(p.floor_known(), p.floor_mm());
  json["largest_part"] = largest_part_of(p);
  json["undecided"] = undecided_json(p.decided(p.undecided));
  return json;
}

Json curve_json(const SymmetryCurve& curve) {
  size_t undecided = 0;
  for (size_t i = 1; i < curve.time_s.size(); ++i) undecided += curve.undecided(i);
  const size_t most = largest_difference(curve);
  Json json;
  json["jitter_mm"] = 1e3 * curve.jitter_m;
  json["S_most"] = number(curve.s[most]);
  json["S_most_at_s"] = curve.known() ? Json(curve.time_s[most]) : Json(nullptr);
  const std::vector<double> floors = curve.floors();
  json["S_floor_there"] = floors.empty() ? Json(nullptr) : number(std::log(floors[most]));
  json["undecided_samples"] = undecided;
  json["samples"] = curve.time_s.size() - 1;
  json["verdict"] = verdict_of(curve);
  return json;
}

Json map_json(const Asymmetry& map) {
  const AsymmetrySummary& worst = map.frames[static_cast<size_t>(map.worst_frame)];
  Json json;
  json["plane_normal"] = {map.plane.normal.x(), map.plane.normal.y(), map.plane.normal.z()};
  json["plane_offset_mm"] = 1e3 * map.plane.offset_m;
  json["plane_turned_from_landmarks_deg"] = map.plane.turned_deg;
  json["rest_rms_mm"] = number(map.rest_rms_mm);
  json["rest_p95_mm"] = number(map.rest_p95_mm);
  json["paired_share"] = map.paired_share;
  json["worst_frame"] = map.worst_frame;
  json["worst_face_rms_mm"] = number(worst.face_rms_mm);
  json["worst_face_p95_mm"] = number(worst.face_p95_mm);
  json["worst_mouth_rms_mm"] = number(worst.mouth_rms_mm);
  json["worst_mouth_p95_mm"] = number(worst.mouth_p95_mm);
  if (map.mesh_floor) {
    json["mesh_floor_face_rms_mm"] = number(map.mesh_floor->face_rms_mm);
    json["mesh_floor_mouth_rms_mm"] = number(map.mesh_floor->mouth_rms_mm);
  }
  return json;
}

}  // namespace

Json commissure_json(const Excursions& excursions) {
  for (const PairExcursion& p : excursions.pairs)
    if (p.left == excursions.commissure.left && p.left >= 0) return pair_json(p);
  return nullptr;
}

Json summary_of(const SymmetryMeasures& measures) {
  Json json = curve_json(measures.curve);
  json["jitter_known"] = measures.excursions.known.jitter;
  json["lowpass_hz"] = measures.excursions.lowpass_hz;
  const Commissure& mouth = measures.excursions.commissure;
  json["commissure_from_midlip_mm"] = both(mouth.left_from_midlip_mm, mouth.right_from_midlip_mm);
  Json pairs = Json::array();
  for (const PairExcursion& p : measures.excursions.pairs) pairs.push_back(pair_json(p));
  if (const Json corners = commissure_json(measures.excursions); !corners.is_null())
    json["commissure"] = corners;
  json["excursions"] = pairs;
  if (const auto& floor = measures.curve.mesh_noise; !floor.empty())
    json["mesh_floor"] = {{"known", true},
                          {"xi_there", number(floor[largest_difference(measures.curve)])},
                          {"resolution_mm", 1e3 * kResolution_m}};
  else if (!measures.no_mesh_floor.empty())
    json["mesh_floor"] = {{"known", false}, {"why", measures.no_mesh_floor}};
  if (measures.map) json["asymmetry_map"] = map_json(*measures.map);
  return json;
}

}  // namespace hyperex::metrics
