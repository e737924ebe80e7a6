// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visits_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/core/run_together.hpp"
#include "hyperex/core/version.hpp"
#include "hyperex/report/page_data.hpp"
#include "hyperex/report/page_template.hpp"
#include "hyperex/visits/summary.hpp"
#include "hyperex/visits/visit_picture.hpp"

namespace hyperex::visits {
namespace {
using nlohmann::json;

/// A number with `digits` decimals; null where it is not measured.
json rounded(double value, int digits) {
  if (!std::isfinite(value)) return nullptr;
  const double scale = std::pow(10, digits);
  return std::round(value * scale) / scale;
}

/// The page rounds figures where it prints them: rounded here, too, they would differ from those of
/// the terminal.
json exact(double value) {
  return std::isfinite(value) ? json(value) : json();
}

json low_of(const std::optional<Interval>& interval) {
  return interval ? exact(interval->low) : json();
}

json high_of(const std::optional<Interval>& interval) {
  return interval ? exact(interval->high) : json();
}

json value_json(const std::optional<VisitValue>& value) {
  if (!value) return nullptr;
  return {{"value", exact(value->value)},
          {"low", low_of(value->measured)},
          {"high", high_of(value->measured)}};
}

/// Of a visit against the first; null where they are not compared.
json change_json(const Comparison& comparison, const MeasureOverVisits& one, std::size_t visit) {
  const std::optional<Change>& change = one.changes[visit];
  if (!change) return nullptr;
  return {{"value", exact(change->value)},
          {"low", low_of(change->all)},
          {"high", high_of(change->all)},
          {"low_measured", low_of(change->measured)},
          {"high_measured", high_of(change->measured)},
          {"beyond", words_of(change->beyond)},
          {"doubtful", is_doubtful(comparison, one, visit)},
          {"largest", change->largest}};
}

json measures_json(const Comparison& comparison) {
  json all = json::array();
  for (const MeasureOverVisits& one : comparison.measures) {
    json values = json::array(), changes = json::array();
    for (const auto& value : one.values) values.push_back(value_json(value));
    for (std::size_t visit = 0; visit < one.changes.size(); ++visit)
      changes.push_back(change_json(comparison, one, visit));
    all.push_back({{"key", one.measure.key},
                   {"words", one.measure.words},
                   {"side", one.measure.side},
                   {"unit", one.measure.unit},
                   {"values", values},
                   {"changes", changes}});
  }
  return all;
}

/// Pictures as data URIs, one per visit; empty where directions are not known.
std::vector<std::string> pictures_of(const Comparison& comparison) {
  std::vector<std::string> pictures(comparison.faces.size());
  run_each(pictures.size(), [&](std::size_t v) {
    if (const auto image = draw_peak(comparison.faces[v].front()))
      pictures[v] = "data:image/png;base64," + report::base64(render::png_bytes(*image));
  });
  return pictures;
}

/// Which points a recording lacks, by which directions are found.
std::string why_no_directions(const MeasuredFace& face) {
  static const std::vector<std::pair<std::string, std::string>> needed = {
      {"exocanthion_R", "the outer corner of the right eye"},
      {"exocanthion_L", "the outer corner of the left eye"},
      {"cheilion_R", "the right corner of the mouth"},
      {"cheilion_L", "the left corner of the mouth"}};
  std::vector<std::string> missing;
  for (const auto& [name, words] : needed)
    if (!face.rest.contains(name)) missing.push_back(words);
  if (missing.empty()) return "the corners of the eyes and of the mouth lie on one line";
  return fmt::format("{} {} not recorded", fmt::join(missing, " and "),
                     missing.size() > 1 ? "are" : "is");
}

/// Why a visit has no picture; else empty. The first visit determines the directions of all.
std::string why_no_picture(const Comparison& comparison, std::size_t visit, bool without) {
  if (!without) return "";
  if (comparison.faces.front().front().state.axes.allFinite())
    return "fewer than three still points in common with the first visit";
  return why_no_directions(comparison.faces.front().front()) +
         (visit == 0 ? "" : " at the first visit");
}

json visits_json(const Comparison& comparison) {
  const std::vector<std::string> pictures = pictures_of(comparison);
  json all = json::array();
  for (std::size_t v = 0; v < comparison.faces.size(); ++v) {
    const VisitEntry& entry = comparison.file.visits[v];
    const MeasuredFace& face = comparison.faces[v].front();
    json names = json::array();
    for (const auto& recording : entry.recordings) names.push_back(recording.filename().string());
    all.push_back({{"label", entry.label},
                   {"note", entry.note},
                   {"recordings", names},
                   {"peak_s", exact(face.peak_s)},
                   {"jitter_mm", face.jitter_known ? exact(1e3 * face.jitter_m) : json()},
                   {"head_fit_mm", v == 0 ? json() : exact(1e3 * face.head_fit_m)},
                   {"eye_distance_mm", exact(1e3 * face.eye_distance_m)},
                   {"picture", pictures[v]},
                   {"no_picture", why_no_picture(comparison, v, pictures[v].empty())}});
  }
  return all;
}

/// At most kMost samples. At time 0 the movement first reaches half of its peak.
json curves_json(const Comparison& comparison) {
  constexpr std::size_t kMost = 400;
  json all = json::array();
  for (std::size_t v = 0; v < comparison.faces.size(); ++v)
    for (std::size_t r = 0; r < comparison.faces[v].size(); ++r) {
      const MeasuredFace& face = comparison.faces[v][r];
      const std::size_t every = (face.time_s.size() + kMost - 1) / kMost;
      json time = json::array(), right = json::array(), left = json::array();
      for (std::size_t k = 0; k < face.time_s.size(); k += every) {
        time.push_back(rounded(face.time_s[k] - face.half_s, 3));
        right.push_back(face.corner_mm[0].empty() ? json() : rounded(face.corner_mm[0][k], 4));
        left.push_back(face.corner_mm[1].empty() ? json() : rounded(face.corner_mm[1][k], 4));
      }
      all.push_back({{"visit", v},
                     {"recording", r},
                     {"time_s", time},
                     {"right_mm", right},
                     {"left_mm", left}});
    }
  return all;
}

json repetition_json(const Comparison& comparison) {
  const char* const source = comparison.repetition_measured ? "recordings"
                             : comparison.file.repetition_m ? "stated"
                                                            : "default";
  return {{"mm", exact(1e3 * comparison.repetition_m)},
          {"source", source},
          {"text", repetition_sentence(comparison)}};
}

}  // namespace

void write_visits_page(const std::filesystem::path& file, const Comparison& comparison) {
  const json manifest = {
      {"version", 1},
      {"program", fmt::format("Hyperex {}", version())},
      {"patient", comparison.file.patient},
      {"expression", comparison.file.expression.name},
      {"peak_by", moved_part(comparison.file.expression.movement)},
      {"repetition", repetition_json(comparison)},
      {"visits", visits_json(comparison)},
      {"curves", curves_json(comparison)},
      {"measures", measures_json(comparison)},
      {"summary", summary(comparison)},
      {"notes", remarks(comparison)},
      {"choices", choices(comparison)},
      {"caveat",
       "Hyperex is research software, no medical device: these figures are not for diagnosis or "
       "treatment."}};
  report::write_page(file, report::page_template(report::Page::visits), manifest, {});
}

}  // namespace hyperex::visits
