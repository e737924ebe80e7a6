// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/scan_measures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "hyperex/core/within_95.hpp"
#include "hyperex/face/landmark_errors.hpp"
#include "hyperex/metrics/asymmetry.hpp"
#include "hyperex/metrics/fold_depth.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/read_scan.hpp"

namespace hyperex::visits {
namespace {

using metrics::FoldCut;

/// NaN where a cut lacks the value, so that the same cuts count at every visit.
double mean_of(const std::array<FoldCut, 3>& cuts, double FoldCut::*value) {
  double sum = 0;
  for (const FoldCut& cut : cuts) sum += cut.*value;
  return sum / double(cuts.size());
}

void add_fold(std::vector<ScanMeasure>& all, const std::string& key, const std::string& words,
              bool at_peak, double FoldCut::*value) {
  for (const bool left : {false, true})
    all.push_back({key, words, left ? "L" : "R", "mm", at_peak,
                   [=](const TriMesh& skin, const io::Landmarks& landmarks) {
                     return mean_of(metrics::fold_cuts(skin, landmarks, left), value);
                   }});
}

std::vector<ScanMeasure> all_scan_measures() {
  std::vector<ScanMeasure> all;
  all.push_back({"rest_asymmetry", "Face at rest: distance from its mirror image", "", "mm", false,
                 [](const TriMesh& skin, const io::Landmarks& landmarks) {
                   return metrics::rest_asymmetry(skin, landmarks).rest_rms_mm;
                 }});
  add_fold(all, "fold_rest_depth", "Fold nose to mouth: depth at rest", false, &FoldCut::depth_mm);
  add_fold(all, "fold_depth", "Fold nose to mouth: depth at the peak", true, &FoldCut::depth_mm);
  add_fold(all, "fold_outward", "Fold nose to mouth: place outward at the peak", true,
           &FoldCut::outward_mm);
  return all;
}

/// The scans of a visit; empty where the visit has none.
struct VisitScans {
  std::optional<MeasuredScan> rest, peak;
};

std::string not_measured(const ScanMeasure& measure, const VisitEntry& visit) {
  return fmt::format(
      "{}: {}{}{} is not measured: the scan has a hole or an edge within 20 mm, or no fold of 0.5 "
      "mm",
      visit.label, measure.words, measure.side.empty() ? "" : ", ", measure.side);
}

}  // namespace

const std::vector<ScanMeasure>& scan_measures() {
  static const std::vector<ScanMeasure> all = all_scan_measures();
  return all;
}

MeasuredScan read_visit_scan(const VisitScan& scan, std::optional<io::LengthUnit> unit,
                             std::vector<std::string>& remarks) {
  scene::Scene scene;
  scene.scan.unit = unit;
  scene.scan.source.file = scan.file;
  scene.scan.landmarks = scan.landmarks;
  session::Inputs in;
  session::read_scan(scene, in);
  io::Landmarks given = session::given_landmarks(scene);
  if (given.empty()) given = session::find_landmarks(in.scan, "no landmarks are given", in.notes);
  session::complete_landmarks(scene, given, in.scan, in);
  const std::string name = scan.file.filename().string();
  for (const Note& note : in.notes)
    remarks.push_back(note.id == "scan.unit_guessed"
                          ? fmt::format("{}: the unit is {}; unit of the visits states it", name,
                                        io::unit_note(in.scan))
                          : fmt::format("{}: {}", name, note.text));
  return {std::move(in.scan.mesh), std::move(in.landmarks)};
}

Estimate estimate(const ScanMeasure& measure, const MeasuredScan& scan, double repetition_m) {
  Estimate out;
  out.value = measure.value(scan.skin, scan.landmarks);
  if (std::isnan(out.value)) return out;
  double squares = 0;
  int count = 0;
  std::mt19937 random(1);
  for (int draw = 0; draw < kLandmarkDraws; ++draw) {
    const double value =
        measure.value(scan.skin, face::with_errors(scan.landmarks, face::kLandmarkError_m, random));
    if (std::isnan(value)) continue;
    squares += std::pow(value - out.value, 2);
    ++count;
  }
  if (count > 0) out.errors.add(metrics::ErrorPart::landmarks, squares / count, count);
  out.errors.add(metrics::ErrorPart::repetition,
                 std::pow(1e3 * repetition_m / (kWithin95 * std::sqrt(2.0)), 2));
  return out;
}

void add_scan_measures(Comparison& comparison) {
  std::vector<VisitScans> scans;
  for (const VisitEntry& visit : comparison.file.visits) {
    VisitScans& has = scans.emplace_back();
    if (visit.rest_scan)
      has.rest = read_visit_scan(*visit.rest_scan, comparison.file.unit, comparison.scan_remarks);
    if (visit.peak_scan)
      has.peak = read_visit_scan(*visit.peak_scan, comparison.file.unit, comparison.scan_remarks);
  }
  for (const ScanMeasure& measure : scan_measures()) {
    std::vector<std::optional<Estimate>> found;
    for (std::size_t v = 0; v < scans.size(); ++v) {
      const auto& scan = measure.at_peak ? scans[v].peak : scans[v].rest;
      found.emplace_back();
      if (!scan) continue;
      found.back() = estimate(measure, *scan, comparison.repetition_m);
      if (std::isnan(found.back()->value))
        comparison.scan_remarks.push_back(not_measured(measure, comparison.file.visits[v]));
    }
    MeasureOverVisits one =
        over_visits({measure.key, measure.words, measure.side, measure.unit, {}}, found);
    if (std::ranges::any_of(one.values, [](const auto& value) { return value.has_value(); }))
      comparison.measures.push_back(std::move(one));
  }
}

}  // namespace hyperex::visits
