// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry_tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>

#include "hyperex/core/files.hpp"
#include "hyperex/metrics/mesh_floor.hpp"

namespace hyperex::metrics {
namespace {
using Json = nlohmann::ordered_json;

std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

/// A field each, or as many empty ones.
std::string at(const std::vector<double>& values, size_t i) {
  return i < values.size() ? field(values[i]) : std::string();
}

std::string log_at(const std::vector<double>& values, size_t i) {
  return i < values.size() ? field(std::log(values[i])) : std::string();
}

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

Json both(double left, double right) {
  return {{"L", number(left)}, {"R", number(right)}};
}

Json pair_json(const PairExcursion& p) {
  Json json;
  json["point"] = p.name;
  json["excursion_mm"] = both(p.left_side.excursion_mm, p.right_side.excursion_mm);
  json["excursion_ratio_R_L"] = number(p.excursion_ratio);
  json["path_mm"] = both(p.left_side.path_mm, p.right_side.path_mm);
  json["path_ratio_R_L"] = number(p.path_ratio);
  json["peak_speed_mm_s"] = both(p.left_side.peak_speed_mm_s, p.right_side.peak_speed_mm_s);
  json["peak_speed_ratio_R_L"] = number(p.speed_ratio);
  json["speed_correlation"] = number(p.speed_correlation);
  json["path_floor_mm"] = p.path_floor_mm;
  json["path_undecided"] = p.path_undecided;
  json["peak_speed_floor_mm_s"] = p.peak_speed_floor_mm_s;
  json["peak_speed_undecided"] = p.peak_speed_undecided;
  json["speed_correlation_undecided"] = p.speed_correlation_undecided;
  json["difference_mm"] = number(p.difference_mm());
  json["jitter_floor_mm"] = p.jitter_floor_mm;
  json["mesh_floor_mm"] = number(p.mesh_floor_mm);
  json["floor_mm"] = number(p.floor_mm());
  json["undecided"] = p.undecided;
  return json;
}

Json curve_json(const SymmetryCurve& curve) {
  size_t undecided = 0;
  for (size_t i = 1; i < curve.time_s.size(); ++i) undecided += curve.undecided(i);
  const size_t most = largest_difference(curve);
  Json json;
  json["jitter_mm"] = 1e3 * curve.jitter_m;
  json["S_most"] = number(curve.s[most]);
  json["S_most_at_s"] = curve.time_s[most];
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

size_t largest_difference(const SymmetryCurve& curve) {
  size_t most = 0;
  for (size_t i = 1; i < curve.time_s.size(); ++i)
    if (std::abs(curve.xi_left[i] - curve.xi_right[i]) >
        std::abs(curve.xi_left[most] - curve.xi_right[most]))
      most = i;
  return most;
}

std::string verdict_of(const SymmetryCurve& curve) {
  const size_t most = largest_difference(curve);
  const double apart = curve.xi_left[most] - curve.xi_right[most];
  if (std::abs(apart) <= curve.floor) return "both sides stretch alike";
  if (curve.undecided(most))
    return std::string("undecided: the sides differ by less than ") +
           (curve.noise.empty()        ? "the mesh alone makes them"
            : curve.mesh_noise.empty() ? "jitter alone makes them"
                                       : "jitter or the mesh alone make them");
  return fmt::format("the sides differ most at {:.3g} s, by |xi_L - xi_R| = {:.3g}",
                     curve.time_s[most], std::abs(apart));
}

void write_symmetry_csv(const std::filesystem::path& file, const SymmetryMeasures& measures) {
  const SymmetryCurve& curve = measures.curve;
  const Commissure& mouth = measures.excursions.commissure;
  write_file_atomically(file, [&](std::ostream& stream) {
    stream << "time_s,xi_L,xi_R,S_ln,floor,S_floor,S_floor_jitter,S_floor_mesh,decided,"
              "commissure_L_mm,commissure_R_mm,"
              "commissure_speed_L_mm_s,commissure_speed_R_mm_s";
    if (measures.map)
      stream << ",asymmetry_face_rms_mm,asymmetry_face_p95_mm,asymmetry_mouth_rms_mm,"
                "asymmetry_mouth_p95_mm";
    stream << '\n';
    const std::vector<double> floors = curve.floors();
    for (size_t i = 0; i < curve.time_s.size(); ++i) {
      fmt::print(stream, "{},{},{},{},{:.9g},{},{},{},{},{},{},{},{}", field(curve.time_s[i]),
                 field(curve.xi_left[i]), field(curve.xi_right[i]), field(curve.s[i]), curve.floor,
                 log_at(floors, i), log_at(curve.noise, i), log_at(curve.mesh_noise, i),
                 floors.empty()       ? ""
                 : curve.undecided(i) ? "0"
                                      : "1",
                 at(mouth.left_mm, i), at(mouth.right_mm, i), at(mouth.left_mm_s, i),
                 at(mouth.right_mm_s, i));
      if (measures.map) {
        const AsymmetrySummary& frame = measures.map->frames.at(i);
        fmt::print(stream, ",{},{},{},{}", field(frame.face_rms_mm), field(frame.face_p95_mm),
                   field(frame.mouth_rms_mm), field(frame.mouth_p95_mm));
      }
      stream << '\n';
    }
  });
}

void write_excursions_csv(const std::filesystem::path& file, const Excursions& excursions) {
  write_file_atomically(file, [&](std::ostream& stream) {
    stream << "point,excursion_L_mm,excursion_R_mm,excursion_ratio_R_L,path_L_mm,path_R_mm,"
              "path_ratio_R_L,peak_speed_L_mm_s,peak_speed_R_mm_s,peak_speed_ratio_R_L,"
              "speed_correlation,difference_mm,jitter_floor_mm,mesh_floor_mm,decided,"
              "path_floor_mm,peak_speed_floor_mm_s,path_decided,peak_speed_decided,"
              "speed_correlation_decided\n";
    for (const PairExcursion& p : excursions.pairs)
      fmt::print(stream, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", p.name,
                 field(p.left_side.excursion_mm), field(p.right_side.excursion_mm),
                 field(p.excursion_ratio), field(p.left_side.path_mm), field(p.right_side.path_mm),
                 field(p.path_ratio), field(p.left_side.peak_speed_mm_s),
                 field(p.right_side.peak_speed_mm_s), field(p.speed_ratio),
                 field(p.speed_correlation), field(p.difference_mm()), field(p.jitter_floor_mm),
                 field(p.mesh_floor_mm), p.undecided ? 0 : 1, field(p.path_floor_mm),
                 field(p.peak_speed_floor_mm_s), p.path_undecided ? 0 : 1,
                 p.peak_speed_undecided ? 0 : 1, p.speed_correlation_undecided ? 0 : 1);
  });
}

Json summary_of(const SymmetryMeasures& measures) {
  Json json = curve_json(measures.curve);
  json["lowpass_hz"] = measures.excursions.lowpass_hz;
  const Commissure& mouth = measures.excursions.commissure;
  json["commissure_from_midlip_mm"] = both(mouth.left_from_midlip_mm, mouth.right_from_midlip_mm);
  Json pairs = Json::array();
  for (const PairExcursion& p : measures.excursions.pairs) {
    if (p.left == mouth.left && mouth.left >= 0) json["commissure"] = pair_json(p);
    pairs.push_back(pair_json(p));
  }
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
