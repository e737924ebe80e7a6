// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/corner_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/metrics/symmetry_json.hpp"

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;

double corner_number(const Json& json, const std::string& key, double otherwise) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : otherwise;
}

/// Rounded as it is printed, so that a difference in words agrees with the printed figures.
double rounded_mm(double mm) {
  return std::round(10 * mm) / 10;
}

/// Whether the corners' difference counts, and what most of the floor comes from.
std::string floor_clause(const Json& corners, double apart_mm) {
  const double floor_mm = corner_number(corners, "floor_mm", 0);
  const bool unknown = corners.contains("undecided") && corners["undecided"].is_null();
  const std::string cannot_tell = "the recording cannot tell, as its jitter is not known";
  if (floor_mm <= 0) return unknown ? ": " + cannot_tell : "";
  return fmt::format(
      ": {} the floor of {} mm ({}){}",
      !unknown && corners.value("undecided", false) ? "undecided, below" : "more than",
      floor_mm < 0.095 || std::abs(apart_mm - floor_mm) < 0.1 ? fmt::format("{:.2f}", floor_mm)
                                                              : fmt::format("{:.1f}", floor_mm),
      corners.value("largest_part", "mesh"), unknown ? ", but " + cannot_tell : "");
}

/// A corner of the mouth in base and in a variant; what is not known is not a number.
struct CornerChange {
  double from_mm, to_mm, band_mm;
  double decided;     ///< whether the change from rest exceeds its band, 1 or 0
  bool jitter_known;  ///< else the band is not
  double along_mm;    ///< along the way of base
  double far_mm, far_s;
  bool weaker;  ///< some muscle of that side pulls less than in base
};

/// "is dragged 2.1 mm farther": `mm` more, or less, than base.
std::string moved_words(double mm, bool weaker) {
  if (mm < 0) return fmt::format("{} {:.1f} mm less", weaker ? "moves" : "follows", -mm);
  return fmt::format("{} {:.1f} mm farther", weaker ? "is dragged" : "moves", mm);
}

/// Where the greatest excursions differ by much less than the paths do: ", but up to 3.7 mm from
/// its place without the change, at 1.93 s".
std::string path_clause(const CornerChange& c, double by_mm) {
  const double least = std::fmax(0.3, std::isnan(c.band_mm) ? 0 : c.band_mm);
  if (!(c.far_mm > least) || c.far_mm < 1.5 * std::abs(by_mm)) return "";
  return fmt::format(", but up to {:.1f} mm from its place without the change, at {:.2f} s",
                     c.far_mm, c.far_s);
}

std::string change_words(const CornerChange& c) {
  constexpr double same_mm = 0.05;
  const double from = rounded_mm(c.from_mm), to = rounded_mm(c.to_mm);
  const double along = std::isnan(c.along_mm) ? c.to_mm : c.along_mm;
  // Along base's way as far as from rest: the figures from rest say it all.
  const bool same_way = std::abs(c.to_mm - along) <= std::max(0.25, 0.1 * c.to_mm);
  const double by = same_way ? to - from : rounded_mm(along) - from;
  if (same_way && (std::abs(by) < same_mm || std::abs(c.to_mm - c.from_mm) < same_mm))
    return fmt::format("{:.1f} mm, unchanged", from) + path_clause(c, 0);
  const std::string way = fmt::format("{:.1f} to {:.1f} mm, ", from, to);
  std::string band = std::isnan(c.band_mm) ? "" : fmt::format(" (+- {:.1f})", c.band_mm);
  if (std::abs(same_way ? c.to_mm - c.from_mm : by) < c.band_mm || (same_way && c.decided == 0))
    return way + "undecided" + band + path_clause(c, by);
  if (!c.jitter_known) band = " (cannot tell: the recording's jitter is not known)";
  if (!same_way && along < 0)
    return way + fmt::format("goes {:.1f} mm the other way", -rounded_mm(along)) + band +
           path_clause(c, by);
  return way + moved_words(by, c.weaker) + (same_way ? "" : " along its way without the change") +
         band + path_clause(c, by);
}

std::string side_words(const Json& base, const Json& variant, const std::string& side) {
  const double unknown = std::nan("");
  const std::string corner = "commissure_" + side;
  const auto number = [&](const Json& row, const char* what) {
    return corner_number(row, corner + what, unknown);
  };
  const Json weaker = variant.value("weaker_sides", Json::array());
  const CornerChange c{number(base, "_mm"),
                       number(variant, "_mm"),
                       number(variant, "_band_mm"),
                       number(variant, "_decided"),
                       variant.value("jitter_known", true),
                       number(variant, "_along_base_mm"),
                       number(variant, "_from_base_mm"),
                       number(variant, "_from_base_s"),
                       std::find(weaker.begin(), weaker.end(), Json(side)) != weaker.end()};
  return std::isnan(c.from_mm) || std::isnan(c.to_mm) ? "not known" : change_words(c);
}

std::string line_of(const Json& corners) {
  if (!corners.contains("excursion_mm") || !corners["excursion_mm"]["L"].is_number()) return "";
  const double left = corners["excursion_mm"]["L"], right = corners["excursion_mm"]["R"];
  const std::string line = fmt::format(
      "corners of the mouth: right {:.1f} mm, left {:.1f} mm, a difference of {:.1f} mm",
      rounded_mm(right), rounded_mm(left), std::abs(rounded_mm(left) - rounded_mm(right)));
  return line + floor_clause(corners, std::abs(left - right)) + "\n";
}

}  // namespace

std::string corners_line(const Json& summary) {
  const auto& symmetry = summary["symmetry"];
  return symmetry.contains("commissure") ? line_of(symmetry["commissure"]) : "";
}

std::string corners_line(const metrics::Excursions& excursions) {
  const Json corners = metrics::commissure_json(excursions);
  return corners.is_null() ? "" : line_of(corners);
}

std::string rescaled_line(const Json& summary) {
  if (!summary.contains("remarks")) return "";
  for (const auto& remark : summary["remarks"])
    if (remark.value("id", "") == "recording.rescaled") return remark.value("text", "") + "\n";
  return "";
}

std::string variant_lines(const Json& summary) {
  std::string lines;
  if (!summary.contains("variants")) return lines;
  const auto& table = summary["variants"]["table"];
  for (std::size_t i = 1; i < table.size(); ++i)
    lines += fmt::format("  {}: corner of the mouth right {}; left {}\n",
                         table[i]["name"].get<std::string>(), side_words(table[0], table[i], "R"),
                         side_words(table[0], table[i], "L"));
  if (!lines.empty())
    lines +=
        "  (each corner's greatest distance from rest; R and L are the subject's own sides; +-: "
        "what one other mesh and 95 % of the recording's jitter could make; --error-budget states "
        "all that could)\n";
  return lines;
}

}  // namespace hyperex::run
