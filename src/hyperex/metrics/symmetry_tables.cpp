// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry_tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>

#include "hyperex/core/files.hpp"
#include "hyperex/metrics/nan.hpp"

namespace hyperex::metrics {
namespace {
std::string field(double value) {
  return std::isfinite(value) ? fmt::format("{:.9g}", value) : std::string();
}

/// The value as a field, or an empty field.
std::string at(const std::vector<double>& values, size_t i) {
  return i < values.size() ? field(values[i]) : std::string();
}

const char* decided_field(const std::optional<bool>& decided) {
  return !decided ? "" : *decided ? "1" : "0";
}

std::string floor_field(bool known, double floor) {
  return field(known ? floor : kNan);
}

std::string log_at(const std::vector<double>& values, size_t i) {
  return i < values.size() ? field(std::log(values[i])) : std::string();
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
  if (std::isnan(apart)) return "not known, as a corner of the mouth is not recorded";
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
    stream << "time_s,xi_R,xi_L,S_ln,floor,S_floor,S_floor_jitter,S_floor_mesh,decided,"
              "commissure_R_mm,commissure_L_mm,"
              "commissure_speed_R_mm_s,commissure_speed_L_mm_s";
    if (measures.map)
      stream << ",asymmetry_face_rms_mm,asymmetry_face_p95_mm,asymmetry_mouth_rms_mm,"
                "asymmetry_mouth_p95_mm";
    stream << '\n';
    const std::vector<double> floors = curve.floors();
    for (size_t i = 0; i < curve.time_s.size(); ++i) {
      fmt::print(stream, "{},{},{},{},{:.9g},{},{},{},{},{},{},{},{}", field(curve.time_s[i]),
                 field(curve.xi_right[i]), field(curve.xi_left[i]), field(curve.s[i]), curve.floor,
                 log_at(floors, i), log_at(curve.noise, i), log_at(curve.mesh_noise, i),
                 floors.empty()       ? ""
                 : curve.undecided(i) ? "0"
                                      : "1",
                 at(mouth.right_mm, i), at(mouth.left_mm, i), at(mouth.right_mm_s, i),
                 at(mouth.left_mm_s, i));
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
    stream << "point,excursion_R_mm,excursion_L_mm,excursion_ratio_R_L,path_R_mm,path_L_mm,"
              "path_ratio_R_L,peak_speed_R_mm_s,peak_speed_L_mm_s,peak_speed_ratio_R_L,"
              "speed_correlation,difference_mm,jitter_floor_mm,mesh_floor_mm,pose_floor_mm,"
              "repetition_floor_mm,floor_mm,decided,"
              "path_floor_mm,peak_speed_floor_mm_s,path_decided,peak_speed_decided,"
              "speed_correlation_decided\n";
    for (const PairExcursion& p : excursions.pairs)
      fmt::print(stream, "{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n",
                 p.name, field(p.right_side.excursion_mm), field(p.left_side.excursion_mm),
                 field(p.excursion_ratio), field(p.right_side.path_mm), field(p.left_side.path_mm),
                 field(p.path_ratio), field(p.right_side.peak_speed_mm_s),
                 field(p.left_side.peak_speed_mm_s), field(p.speed_ratio),
                 field(p.speed_correlation), field(p.difference_mm()),
                 floor_field(p.known.jitter, p.jitter_floor_mm), field(p.mesh_floor_mm),
                 floor_field(p.pose_floor_known(), p.pose_floor_mm), field(p.repetition_floor_mm),
                 floor_field(p.floor_known(), p.floor_mm()), decided_field(p.decided(p.undecided)),
                 floor_field(p.known.jitter, p.path_floor_mm),
                 floor_field(p.known.jitter, p.peak_speed_floor_mm_s),
                 decided_field(p.decided(p.path_undecided)),
                 decided_field(p.decided(p.peak_speed_undecided)),
                 decided_field(p.decided(p.speed_correlation_undecided)));
  });
}

}  // namespace hyperex::metrics
