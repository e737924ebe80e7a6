// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/corner_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hyperex/core/held_against.hpp"
#include "hyperex/metrics/symmetry_json.hpp"

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;

/// A change below half of the last digit printed counts as none.
constexpr double kSame_mm = 0.05;
/// A floor below this would be printed as 0.000, as that of points without any noise. It is none.
constexpr double kNoFloor_mm = 0.0005;

double corner_number(const Json& json, const std::string& key, double otherwise) {
  return json.contains(key) && json[key].is_number() ? json[key].get<double>() : otherwise;
}

/// What the error budget says of a corner of the mouth; null where it says nothing. `variant` is
/// empty for base, `side` for the difference of both.
const Json* budgeted(const Json& summary, const char* figure, const std::string& variant,
                     const std::string& side) {
  if (!summary.contains("error_budget")) return nullptr;
  const Json& budget = summary["error_budget"];
  if (!budget.contains("corners_of_the_mouth")) return nullptr;
  for (const Json& one : budget["corners_of_the_mouth"])
    if (one.value("figure", "") == figure && one.value("variant", "") == variant &&
        one.value("side", "") == side && corner_number(one, "known_half_width_95_mm", -1) >= 0)
      return &one;
  return nullptr;
}

/// "95 %: +- 2.9", or "at least +- 1.4" where a part of the budget is not known.
std::string budget_band(bool all_known, const std::string& half) {
  return (all_known ? "95 %: +- " : "at least +- ") + half;
}

/// The corners' difference with the interval of the error budget.
std::string difference_with_budget(const Json& figure, double shown_mm, double exact_mm) {
  const bool known = figure.contains("half_width_95_mm") && figure["half_width_95_mm"].is_number();
  const HeldAgainst apart =
      held_against(shown_mm, exact_mm, figure["known_half_width_95_mm"].get<double>());
  const std::string part = figure.value("largest_part", "");
  const std::string words = fmt::format("{} mm ({}{})", apart.own, budget_band(known, apart.limit),
                                        part.empty() ? "" : "; mostly " + part);
  if (!figure.contains("decided") || figure["decided"].is_null())
    return words + ": cannot tell, as the recording's jitter is not known";
  return figure["decided"].get<bool>() ? words : words + ": undecided";
}

/// What the corners' difference is, whether it counts, and what most of the floor comes from.
std::string difference_words(const Json& corners, double shown_mm, double exact_mm) {
  const double floor_mm = corner_number(corners, "floor_mm", 0);
  const bool unknown = corners.contains("undecided") && corners["undecided"].is_null();
  const bool jitter_known =
      corners.contains("jitter_floor_mm") && corners["jitter_floor_mm"].is_number();
  const std::string cannot_tell =
      jitter_known ? "the recording cannot tell, as the head's motion is in its points"
                   : "the recording cannot tell, as its jitter is not known";
  if (floor_mm < kNoFloor_mm)
    return fmt::format("{:.1f} mm{}", shown_mm, unknown ? ": " + cannot_tell : "");
  const HeldAgainst apart = held_against(shown_mm, exact_mm, floor_mm);
  return fmt::format(
      "{} mm: {} the floor of {} mm ({}){}", apart.own,
      !unknown && corners.value("undecided", false) ? "undecided, below" : "more than", apart.limit,
      corners.value("largest_part", "mesh"), unknown ? ", but " + cannot_tell : "");
}

/// A corner of the mouth in base and in a variant; what is not known is not a number.
struct CornerChange {
  double from_mm, to_mm, band_mm;
  double twin_band_mm;  ///< by one other mesh and the jitter, also where there is an error budget
  double decided;       ///< whether the change from rest exceeds its band, 1 or 0
  bool jitter_known;    ///< else the band is not, or it is a lower bound where it is of the budget
  bool budgeted;        ///< the band is that of the error budget
  double along_mm;      ///< in the unchanged direction
  double along_band_mm, along_decided;
  double far_mm, far_s;
  bool weaker;  ///< some muscle of that side pulls less than in base
};

/// "is dragged 2.1 mm farther": `mm` more, or less, than base; `size` is its size in words.
std::string moved_words(double mm, const std::string& size, bool weaker) {
  if (mm < 0) return fmt::format("{} {} mm less", weaker ? "moves" : "follows", size);
  return fmt::format("{} {} mm farther", weaker ? "is dragged" : "moves", size);
}

/// Where the greatest excursions differ by much less than the paths do: "at 1.93 s it is 3.7 mm
/// from where it is without the change". The greatest excursions may belong to two different
/// expressions of the recording.
std::string path_words(const CornerChange& c, double by_mm) {
  const double least = std::fmax(0.3, std::isnan(c.twin_band_mm) ? 0 : c.twin_band_mm);
  if (!(c.far_mm > least) || c.far_mm < 1.5 * std::abs(by_mm)) return "";
  return fmt::format("at {:.2f} s it is {:.1f} mm from where it is without the change", c.far_s,
                     c.far_mm);
}

/// Whether the change of the distance from rest is within its band.
bool is_undecided(const CornerChange& c) {
  return std::abs(c.to_mm - c.from_mm) < c.band_mm || c.decided == 0;
}

/// The change in the unchanged direction with its own band: "5.9 mm less (+- 0.8)". The error
/// budget has no interval for it, and a band that leaves most errors out would look like one.
std::string along_words(const CornerChange& c) {
  const double by = printed_change_mm(c.from_mm, c.along_mm), exact = c.along_mm - c.from_mm;
  if (std::abs(by) < kSame_mm) return "unchanged";
  const bool known = !std::isnan(c.along_band_mm) && !c.budgeted;
  const HeldAgainst held = held_against(by, exact, known ? c.along_band_mm : 0);
  const bool undecided =
      c.budgeted ? is_undecided(c) : std::abs(exact) < c.along_band_mm || c.along_decided == 0;
  return fmt::format("{}{} mm {}{}{}", undecided ? "undecided: " : "", held.own,
                     by < 0 ? "less" : "more", known ? fmt::format(" (+- {})", held.limit) : "",
                     undecided || c.jitter_known ? "" : " (cannot tell)");
}

/// Where the corner turns aside, its distance from rest hides how much less it goes where it went:
/// "in the unchanged direction 10.1 to 4.2 mm, 5.9 mm less (+- 0.8)".
std::string direction_words(const CornerChange& c) {
  if (std::isnan(c.along_mm)) return "";
  const bool same_way = std::abs(c.to_mm - c.along_mm) <= std::max(0.25, 0.1 * c.to_mm);
  if (same_way) return "";
  const double from = printed_mm(c.from_mm), along = printed_mm(c.along_mm);
  if (along < 0)
    return fmt::format("{:.1f} mm against the unchanged direction, {}", -along, along_words(c));
  return fmt::format("in the unchanged direction {:.1f} to {:.1f} mm, {}", from, along,
                     along_words(c));
}

/// What the distance from rest hides, one thing at most; empty where it hides nothing.
std::string hidden_words(const CornerChange& c) {
  const std::string aside = direction_words(c);
  return aside.empty() ? path_words(c, printed_change_mm(c.from_mm, c.to_mm)) : aside;
}

/// The change of the distance from rest with its own band.
std::string change_words(const CornerChange& c) {
  const double from = printed_mm(c.from_mm), to = printed_mm(c.to_mm);
  const double by = printed_change_mm(c.from_mm, c.to_mm), exact = c.to_mm - c.from_mm;
  if (std::abs(by) < kSame_mm)
    return fmt::format("{:.1f} mm, {}", from,
                       hidden_words(c).empty() ? "unchanged" : "as far as before");
  const bool known = !std::isnan(c.band_mm);
  const HeldAgainst held = held_against(by, exact, known ? c.band_mm : 0);
  const std::string way = fmt::format("{:.1f} to {:.1f} mm, ", from, to),
                    band = !known ? ""
                           : c.budgeted
                               ? fmt::format(" ({})", budget_band(c.jitter_known, held.limit))
                               : fmt::format(" (+- {})", held.limit);
  if (is_undecided(c))
    return way + fmt::format("undecided: {} mm {}", held.own, by < 0 ? "less" : "more") + band;
  const std::string cannot_tell =
      c.jitter_known ? "" : " (cannot tell: the recording's jitter is not known)";
  return way + moved_words(by, held.own, c.weaker) + band + cannot_tell;
}

/// Where the jaw alone would carry the corner, two sentences; empty where it does not move, or is
/// not known. That of a jaw which only turns is in summary.json.
std::string jaw_sentence(const Json& variant, const std::string& side) {
  const double jaw_mm = corner_number(variant, "commissure_" + side + "_with_jaw_mm", 0);
  if (!(jaw_mm >= kSame_mm)) return "";
  return fmt::format(". Fixed to the lower jaw it would go {:.1f} mm. Skin follows the jaw in part",
                     jaw_mm);
}

/// Why a corner on a side of which no muscle pulls still moves, a line for each such side.
std::string unpulled_lines(const Json& variant) {
  std::string lines;
  for (const Json& side : variant.value("unpulled_sides", Json::array())) {
    const auto letter = side.get<std::string>();
    lines += fmt::format(
        "    no muscle pulls on the {}: its corner moves by no strength of its own, but by the "
        "jaw and the other side{}\n",
        letter == "R" ? "right" : "left", jaw_sentence(variant, letter));
  }
  return lines;
}

/// The interval of the error budget in place of the band, which leaves most errors out.
void take_budget(const Json* figure, CornerChange& c) {
  if (!figure) return;
  c.budgeted = true;
  c.band_mm = (*figure)["known_half_width_95_mm"].get<double>();
  c.jitter_known =
      figure->contains("half_width_95_mm") && (*figure)["half_width_95_mm"].is_number();
  const Json decided = figure->value("decided", Json());
  c.decided = decided.is_boolean() ? double(decided.get<bool>()) : std::nan("");
}

/// False: a run simulated this corner ("R", "L"), and its recording does not show it.
bool is_recorded(const Json& corners, const std::string& side) {
  return !corners.contains("recorded") || corners["recorded"].value(side, true);
}

/// None where a distance from rest is not known.
std::optional<CornerChange> corner_change(const Json& summary, const Json& variant,
                                          const std::string& side) {
  const Json& base = summary["variants"]["table"][0];
  const double unknown = std::nan("");
  const std::string corner = "commissure_" + side;
  const auto number = [&](const Json& row, const char* what) {
    return corner_number(row, corner + what, unknown);
  };
  const Json weaker = variant.value("weaker_sides", Json::array());
  CornerChange c{number(base, "_mm"),
                 number(variant, "_mm"),
                 number(variant, "_band_mm"),
                 number(variant, "_band_mm"),
                 number(variant, "_decided"),
                 variant.value("jitter_known", true),
                 false,
                 number(variant, "_along_base_mm"),
                 number(variant, "_along_base_band_mm"),
                 number(variant, "_along_base_decided"),
                 number(variant, "_from_base_mm"),
                 number(variant, "_from_base_s"),
                 std::find(weaker.begin(), weaker.end(), Json(side)) != weaker.end()};
  take_budget(budgeted(summary, "change", variant.value("name", ""), side), c);
  if (std::isnan(c.from_mm) || std::isnan(c.to_mm)) return std::nullopt;
  return c;
}

/// One line for a variant, and one for each corner whose distance from rest hides something.
std::string corner_lines_of(const Json& summary, const Json& variant) {
  const Json corners = summary.value(Json::json_pointer("/symmetry/commissure"), Json::object());
  std::string changes, hidden;
  for (const auto& [side, name] : {std::pair{"R", "right"}, std::pair{"L", "left"}}) {
    const bool recorded = is_recorded(corners, side);
    const auto change = recorded ? corner_change(summary, variant, side) : std::nullopt;
    changes += fmt::format("{}{} {}", changes.empty() ? "" : "; ", name,
                           change     ? change_words(*change)
                           : recorded ? "not known"
                                      : "not recorded");
    if (const std::string words = change ? hidden_words(*change) : ""; !words.empty())
      hidden += fmt::format("    {} corner: {}\n", name, words);
  }
  return fmt::format("  {}: corner of the mouth {}\n{}", variant["name"].get<std::string>(),
                     changes, hidden);
}

/// What the figures are, which one to quote, and what the bands hold.
std::string legend_lines(bool aside, bool budget) {
  return std::string(
             "  (quote the excursions, in the first line of each variant: each corner's greatest "
             "distance from rest)\n"
             "  (R and L are the subject's own sides; +-: ") +
         (budget ? "what all errors of the error budget together could make of the change before "
                   "it)\n"
                 : "what one other mesh and 95 % of the recording's jitter could make of the "
                   "change before it; --error-budget states all that could)\n") +
         (aside ? std::string("  (the unchanged direction: where the corner goes without the "
                              "change; motion aside of it counts in the excursion, not in it") +
                      (budget ? "; the error budget has no interval for it)\n" : ")\n")
                : "");
}

std::string words_of_corner(const Json& corners, const std::string& side) {
  const double mm = corner_number(corners["excursion_mm"], side, std::nan(""));
  return std::isnan(mm) ? "not recorded" : fmt::format("{:.1f} mm", printed_mm(mm));
}

std::string line_of(const Json& corners, const Json* budget) {
  if (!corners.contains("excursion_mm")) return "";
  if (!is_recorded(corners, "R") || !is_recorded(corners, "L"))
    return fmt::format(
        "corners of the mouth: right {}, left {}: a difference of the sides is not known\n",
        words_of_corner(corners, "R"), words_of_corner(corners, "L"));
  if (!corners["excursion_mm"]["L"].is_number()) return "";
  const double left = corners["excursion_mm"]["L"], right = corners["excursion_mm"]["R"];
  const double shown = std::abs(printed_mm(left) - printed_mm(right)),
               exact = std::abs(left - right);
  return fmt::format("corners of the mouth: right {:.1f} mm, left {:.1f} mm, a difference of {}\n",
                     printed_mm(right), printed_mm(left),
                     budget ? difference_with_budget(*budget, shown, exact)
                            : difference_words(corners, shown, exact));
}

}  // namespace

std::string corners_line(const Json& summary) {
  const auto& symmetry = summary["symmetry"];
  return symmetry.contains("commissure")
             ? line_of(symmetry["commissure"], budgeted(summary, "difference", "", ""))
             : "";
}

std::string corners_line(const metrics::Excursions& excursions, bool doubtful) {
  const Json corners = metrics::commissure_json(excursions);
  std::string line = corners.is_null() ? "" : line_of(corners, nullptr);
  if (doubtful && !line.empty()) line.insert(line.size() - 1, kDoubtfulEnding);
  return line;
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
    lines += corner_lines_of(summary, table[i]) + unpulled_lines(table[i]);
  if (lines.empty()) return lines;
  const bool aside = lines.find("unchanged direction") != std::string::npos;
  return lines + legend_lines(aside, summary.contains("error_budget"));
}

}  // namespace hyperex::run
