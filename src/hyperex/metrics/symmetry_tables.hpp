// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/symmetry.hpp"

namespace hyperex::metrics {

/// All of one motion; docs/symmetry.md defines every number.
struct SymmetryMeasures {
  SymmetryCurve curve;
  Excursions excursions;
  std::optional<Asymmetry> map;  ///< where there is a surface
  std::string no_mesh_floor;     ///< of a simulated face: why it has none, a sentence
};

/// CSV, a row per sample: time_s, xi_L, xi_R, S_ln, floor, S_floor (the larger of the next two),
/// S_floor_jitter, S_floor_mesh, decided (1, 0, or empty without a floor), commissure_L_mm,
/// commissure_R_mm, commissure_speed_L_mm_s, commissure_speed_R_mm_s, and with a map
/// asymmetry_face_rms_mm, asymmetry_face_p95_mm, asymmetry_mouth_rms_mm, asymmetry_mouth_p95_mm.
/// Empty where not measured or not defined; floors are empty where none is known. Samples of curve
/// and map must be the same.
void write_symmetry_csv(const std::filesystem::path& file, const SymmetryMeasures& measures);

/// CSV, a row per pair of points: point; of L, R and as ratio_R_L: excursion_mm, path_mm,
/// peak_speed_mm_s; speed_correlation; difference_mm (L - R of the excursions), jitter_floor_mm,
/// mesh_floor_mm (empty where unknown), decided (1 or 0);
/// path_floor_mm, peak_speed_floor_mm_s, path_decided, peak_speed_decided,
/// speed_correlation_decided.
void write_excursions_csv(const std::filesystem::path& file, const Excursions& excursions);

/// Where the sides differ most and by how much, that they do not, or that it is undecided. Not
/// which side moves more: a stretch does not show it (README), excursions do.
std::string verdict_of(const SymmetryCurve& curve);

/// The sample of largest |xi_L - xi_R|; 0 where nothing is measured.
size_t largest_difference(const SymmetryCurve& curve);

}  // namespace hyperex::metrics
