// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <optional>
#include <string>

#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/excursion.hpp"
#include "hyperex/metrics/symmetry.hpp"

namespace hyperex::metrics {

/// All symmetry measures of one motion. docs/symmetry.md defines every number.
struct SymmetryMeasures {
  SymmetryCurve curve;
  Excursions excursions;
  std::optional<Asymmetry> map;  ///< present if there is a surface
  std::string no_mesh_floor;  ///< for a simulated face without mesh floor: the reason, one sentence
};

/// Writes a CSV with one row per sample: time_s, xi_L, xi_R, S_ln, floor, S_floor (the larger of
/// the next two), S_floor_jitter, S_floor_mesh, decided (1, 0, or empty without a floor),
/// commissure_L_mm, commissure_R_mm, commissure_speed_L_mm_s, commissure_speed_R_mm_s, and with a
/// map also asymmetry_face_rms_mm, asymmetry_face_p95_mm, asymmetry_mouth_rms_mm,
/// asymmetry_mouth_p95_mm. Cells are empty if a value is not measured, not defined or not known.
/// The curve and the map must have the same samples.
void write_symmetry_csv(const std::filesystem::path& file, const SymmetryMeasures& measures);

/// Writes a CSV with one row per pair of points: point; for L, R and as ratio_R_L: excursion_mm,
/// path_mm, peak_speed_mm_s; speed_correlation; difference_mm (L - R of the excursions),
/// jitter_floor_mm, mesh_floor_mm, pose_floor_mm, repetition_floor_mm, floor_mm (of all that are
/// known), decided; path_floor_mm, peak_speed_floor_mm_s, path_decided, peak_speed_decided,
/// speed_correlation_decided. A floor that is not known is empty. decided: 1; 0: below the floor;
/// empty: above it, but not all noise is known (PairExcursion::decided).
void write_excursions_csv(const std::filesystem::path& file, const Excursions& excursions);

/// A sentence: when the two sides differ most and by how much, that they do not differ, or that
/// this is undecided. It does not say which side moves more, because changes of length do not show
/// that (README); excursions do.
std::string verdict_of(const SymmetryCurve& curve);

/// The sample with the largest |xi_L - xi_R|; 0 if nothing is measured.
size_t largest_difference(const SymmetryCurve& curve);

}  // namespace hyperex::metrics
