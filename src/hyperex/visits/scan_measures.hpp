// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/visits/compare_visits.hpp"

namespace hyperex::visits {

/// What is measured on the scans of a visit.
struct ScanMeasure {
  std::string key, words, side, unit;  ///< as of a Measure
  bool at_peak = false;                ///< on peak_scan; else on rest_scan
  /// NaN where the scan lacks a part.
  std::function<double(const TriMesh& skin, const io::Landmarks& landmarks)> value;
};

/// All of them, R before L.
///  rest_asymmetry  distance between the face at rest and its mirror image, rms (rest_asymmetry())
///  fold_rest_depth, fold_depth  of the fold from nose to mouth, mean of three cuts (fold_cuts())
///  fold_outward  mean distance of the fold's deepest points from the line between the wing of the
///                nose and the corner of the mouth: where the fold runs
const std::vector<ScanMeasure>& scan_measures();

/// How often the landmarks' error (face::kLandmarkError_m) is drawn to find what it makes of a
/// measure.
inline constexpr int kLandmarkDraws = 8;

/// One scan with its landmarks, complete.
struct MeasuredScan {
  TriMesh skin;
  io::Landmarks landmarks;
};
/// Reads a scan and its landmarks, or finds them. `unit`: of the scan; nothing: guessed. `remarks`:
/// what was guessed is added, sentences. Throws InputError.
MeasuredScan read_visit_scan(const VisitScan& scan, std::optional<io::LengthUnit> unit,
                             std::vector<std::string>& remarks);

/// The measure with its error: landmarks, and the person's own variation as of one point.
Estimate estimate(const ScanMeasure& measure, const MeasuredScan& scan, double repetition_m);

/// Measures the scans of all visits and adds the measures that some visit has. Throws InputError.
void add_scan_measures(Comparison& comparison);

}  // namespace hyperex::visits
