// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "hyperex/visits/norms.hpp"
#include "hyperex/visits/visit_dates.hpp"
#include "hyperex/visits/visit_figures.hpp"

namespace hyperex::visits {
namespace {

struct Headline {
  const char* key;
  const char* part;  ///< "corner of the mouth"
  const char* more;  ///< words of a positive change
  const char* less;
};

Headline headline_of(Expression::Movement movement) {
  using enum Expression::Movement;
  if (movement == lips) return {"lip_opening", "opening of the lips", "more", "less"};
  if (movement == brows) return {"brow_raise", "brow", "more", "less"};
  if (movement == lids) return {"eye_narrowing", "eye's closure", "more", "less"};
  return {"corner_excursion", "corner of the mouth", "more", "less"};
}

std::string with_side(const std::string& side, const std::string& part) {
  const std::string text = side == "R" ? "right " + part : side == "L" ? "left " + part : part;
  return char(std::toupper(text.front())) + text.substr(1);
}

/// `unit`: " mm", or empty where it stands before the interval.
std::string interval_words(const Interval& interval, const Headline& words, int digits,
                           const std::string& unit) {
  const auto bound = [&](double value) {
    return fmt::format("{}{} {}", figure(std::abs(value)), unit,
                       value < 0 ? words.less : words.more);
  };
  if (interval.low < 0 && interval.high > 0)
    return fmt::format(" (95 %: {} to {})", bound(interval.low), bound(interval.high));
  const double a = std::abs(interval.low), b = std::abs(interval.high);
  return fmt::format(" (95 %: {} to {}{})", figure(std::min(a, b), digits),
                     figure(std::max(a, b), digits), unit);
}

/// " on 2026-03-01", but " (before injection)".
std::string at_visit(const std::string& label) {
  const bool date = !date_of(label).empty();
  return date ? " on " + label : " (" + label + ")";
}

std::string verdict(const Change& change, const Headline& words, const std::string& unit) {
  const int digits = digits_of(change);
  const std::string size = figure(std::abs(change.value), digits);
  const bool nothing = size.find_first_not_of("0.") == std::string::npos;
  const std::string interval =
      change.all ? interval_words(*change.all, words, digits, nothing ? " " + unit : "") : "";
  const std::string amount =
      nothing ? "no change" + interval
              : fmt::format("{} {} {}{}", size, unit, change.value < 0 ? words.less : words.more,
                            interval);
  if (change.beyond == Beyond::yes) return amount + ", beyond what measurement and repetition make";
  if (change.beyond == Beyond::no) {
    if (change.all) return amount + ", within what measurement and repetition make";
    return amount + (change.within_repetition
                         ? ", within what repetition alone makes"
                         : ", within what repetition and the known errors of measurement make");
  }
  return amount +
         "; whether that is beyond what measurement makes cannot be told, as its error is "
         "not known";
}

/// Why the first and the last visit are not compared though both are measured.
std::string why_not_compared(const Comparison& comparison) {
  for (const auto* visit : {&comparison.faces.back(), &comparison.faces.front()})
    for (const MeasuredFace& face : *visit)
      if (face.other_scale)
        return fmt::format("as the face at rest is {:.3g} times as large in {} as in {}",
                           *face.other_scale, face.file, comparison.faces.front().front().file);
  return "as their faces differ in size";
}

std::string sentence(const MeasureOverVisits& one, const Headline& words,
                     const Comparison& comparison) {
  const std::string who = with_side(one.measure.side, words.part);
  const auto& first = one.values.front();
  const auto& last = one.values.back();
  const auto at = [&](const VisitValue& value, const VisitEntry& visit) {
    return fmt::format("{} {}{}", figure(value.value), one.measure.unit, at_visit(visit.label));
  };
  const std::vector<VisitEntry>& visits = comparison.file.visits;
  if (one.values.size() == 1) return fmt::format("{}: {}.", who, at(*first, visits.front()));
  if (!first || !last)
    return fmt::format("{}: not measured at both the first and the last visit.", who);
  const auto& change = one.changes.back();
  return fmt::format("{}: {}, {}: {}.", who, at(*first, visits.front()), at(*last, visits.back()),
                     change ? verdict(*change, words, one.measure.unit)
                            : "not compared, " + why_not_compared(comparison));
}

}  // namespace

std::vector<std::string> summary(const Comparison& comparison) {
  const Headline words = headline_of(comparison.file.expression.movement);
  std::vector<std::string> out;
  for (const MeasureOverVisits& one : comparison.measures)
    if (one.measure.key == words.key) out.push_back(sentence(one, words, comparison));
  if (const Norm* norm = norm_of(comparison.file.expression); norm && !out.empty())
    out.push_back(fmt::format(
        "Healthy adults move the {} by {:.1f} mm, SD {:.1f}, as far as they can ({} adults: {}).",
        norm->part, norm->mean_mm, norm->deviation_mm, norm->people, norm->source));
  return out;
}

std::string repetition_sentence(const Comparison& comparison) {
  if (comparison.repetition_measured)
    return "Repetition is measured: it is how far the recordings of one visit differ from each "
           "other, for each measure" +
           (has_scans(comparison.file) ? fmt::format(". Of scans it is taken to be {:.1f} mm.",
                                                     1e3 * comparison.repetition_m)
                                       : std::string("."));
  const std::string figure = fmt::format(
      "95 % of the differences between two performances of an expression by one person are taken "
      "to be below {:.1f} mm",
      1e3 * comparison.repetition_m);
  if (comparison.file.repetition_m) return figure + ", as repetition_mm states it.";
  return figure +
         ", as in posed smiles of 12 adults a week apart (Tanikawa and Takada, Angle Orthod. 88, "
         "2018, 319). Three recordings per visit would measure it for this person.";
}

std::vector<std::string> remarks(const Comparison& comparison) {
  std::vector<std::string> all;
  if (!comparison.file.order_remark.empty()) all.push_back(comparison.file.order_remark);
  for (const std::string& remark : comparison.scan_remarks)
    if (std::ranges::find(all, remark) == all.end()) all.push_back(remark);
  for (const auto& visit : comparison.faces)
    for (const MeasuredFace& face : visit)
      for (const std::string& remark : face.remarks)
        if (std::ranges::find(all, remark) == all.end()) all.push_back(remark);
  return all;
}

}  // namespace hyperex::visits
