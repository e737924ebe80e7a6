// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

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

const MeasureOverVisits* measured(const Comparison& comparison, const std::string& key,
                                  const std::string& side) {
  for (const MeasureOverVisits& one : comparison.measures)
    if (one.measure.key == key && one.measure.side == side) return &one;
  return nullptr;
}

bool is_beyond(const MeasureOverVisits* one) {
  return one && one->values.front() && one->values.back() && one->changes.back() &&
         one->changes.back()->beyond == Beyond::yes;
}

/// How far a measure changed where that is beyond; else less than any change.
double change_beyond(const MeasureOverVisits* one) {
  return is_beyond(one) ? std::abs(one->changes.back()->value) : -1;
}

/// Adds those sentences that are not there yet.
void add_each_once(const std::vector<std::string>& more, std::vector<std::string>& all) {
  for (const std::string& sentence : more)
    if (std::ranges::find(all, sentence) == all.end()) all.push_back(sentence);
}

/// An angle from 170 to -170 degrees turns by 20, not by 340.
bool has_turned(const MeasureOverVisits* angle) {
  if (!is_beyond(angle)) return false;
  const Change& change = *angle->changes.back();
  const double way = std::abs(change.value);
  return way <= 180 || (change.all && 360 - way > (change.all->high - change.all->low) / 2);
}

/// ", but its direction has changed (upward 3.9 to -3.9 mm)", of a corner of the mouth: where a
/// part of its way is reversed or its angle turned, beyond the interval of that change. Else empty.
std::string change_of_direction(const MeasureOverVisits& excursion, const Comparison& comparison) {
  const Change& size = *excursion.changes.back();
  for (const auto* value : {&excursion.values.front(), &excursion.values.back()})
    if ((*value)->value < 1e3 * kLeastMovement_m) return "";
  const auto from_to = [](const MeasureOverVisits& one, int digits) {
    return fmt::format("{} to {} {}", figure(one.values.front()->value, digits),
                       figure(one.values.back()->value, digits), one.measure.unit);
  };
  std::string parts;
  for (const auto& [key, word] : {std::pair{"corner_up", "upward"},
                                  {"corner_outward", "outward"},
                                  {"corner_forward", "forward"}}) {
    const MeasureOverVisits* part = measured(comparison, key, excursion.measure.side);
    if (is_beyond(part) && part->values.front()->value * part->values.back()->value < 0)
      parts += fmt::format("{}{} {}", parts.empty() ? "" : ", ", word, from_to(*part, 1));
  }
  const MeasureOverVisits* angle = measured(comparison, "smile_angle", excursion.measure.side);
  if (parts.empty() && has_turned(angle)) parts = "angle " + from_to(*angle, 0);
  if (parts.empty()) return "";
  return fmt::format(", {} its direction has changed ({})",
                     size.beyond == Beyond::yes ? "and" : "but", parts);
}

/// Whether some recording of the visit has the points that the movement of this side is judged by.
bool is_recorded(const std::vector<MeasuredFace>& visit, Expression::Movement movement,
                 const std::string& side) {
  using enum Expression::Movement;
  using enum FacePoint;
  const auto on_side = [&](FacePoint right) {
    return of_side(right, side == "L" ? Side::left : Side::right);
  };
  std::vector<FacePoint> points = {on_side(corner_R)};
  if (movement == brows) points = {on_side(brow_R)};
  if (movement == lids) points = {on_side(upper_lid_R), on_side(lower_lid_R)};
  if (movement == lips) points = {inner_upper_lip, inner_lower_lip};
  return std::ranges::any_of(visit, [&](const MeasuredFace& face) {
    return std::ranges::all_of(
        points, [&](FacePoint point) { return at(face.state.rest, point).allFinite(); });
  });
}

std::string sentence(const MeasureOverVisits& one, const Headline& words,
                     const Comparison& comparison) {
  const std::string who = with_side(one.measure.side, words.part);
  const auto at = [&](std::size_t visit) {
    const std::string when = at_visit(comparison.file.visits[visit].label);
    if (const auto& value = one.values[visit])
      return fmt::format("{} {}{}", figure(value->value), one.measure.unit, when);
    return (is_recorded(comparison.faces[visit], comparison.file.expression.movement,
                        one.measure.side)
                ? "not measured"
                : "not recorded") +
           when;
  };
  const std::size_t last = one.values.size() - 1;
  if (last == 0) return fmt::format("{}: {}.", who, at(0));
  std::string judged = "not compared";
  if (const auto& change = one.changes.back()) {
    judged = verdict(*change, words, one.measure.unit);
    if (one.measure.key == "corner_excursion") judged += change_of_direction(one, comparison);
    if (!doubts(comparison).empty()) judged += "; doubtful, as said below";
  } else if (one.values.front() && one.values.back()) {
    judged += ", " + why_not_compared(comparison);
  }
  return fmt::format("{}: {}, {}: {}.", who, at(0), at(last), judged);
}

/// Of a side that no visit records; empty where one does.
std::string not_recorded(const Measure& measure, const Headline& words,
                         const Comparison& comparison) {
  for (const auto& visit : comparison.faces)
    if (is_recorded(visit, comparison.file.expression.movement, measure.side)) return "";
  return with_side(measure.side, words.part) +
         (comparison.faces.size() > 1 ? ": not recorded at any visit." : ": not recorded.");
}

}  // namespace

std::vector<std::string> summary(const Comparison& comparison) {
  const Headline words = headline_of(comparison.file.expression.movement);
  std::vector<std::pair<double, std::string>> sides;
  for (const Measure& measure : measures()) {
    if (measure.key != words.key) continue;
    const MeasureOverVisits* one = measured(comparison, measure.key, measure.side);
    const std::string text =
        one ? sentence(*one, words, comparison) : not_recorded(measure, words, comparison);
    if (!text.empty()) sides.emplace_back(change_beyond(one), text);
  }
  std::ranges::stable_sort(sides, std::ranges::greater(), &std::pair<double, std::string>::first);
  std::vector<std::string> out;
  for (const auto& [change, text] : sides) out.push_back(text);
  for (const std::string& doubt : doubts(comparison)) out.push_back("Doubtful: " + doubt + ".");
  if (const Norm* norm = norm_of(comparison.file.expression); norm && !sides.empty())
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

std::vector<std::string> doubts(const Comparison& comparison) {
  std::vector<std::string> all;
  for (const auto* visit : {&comparison.faces.front(), &comparison.faces.back()})
    for (const MeasuredFace& face : *visit) add_each_once(face.doubts, all);
  return all;
}

bool is_doubtful(const Comparison& comparison, const MeasureOverVisits& one, std::size_t visit) {
  if (!one.measure.value) return false;  // of scans
  const auto doubted = [](const MeasuredFace& face) { return !face.doubts.empty(); };
  return std::ranges::any_of(comparison.faces.front(), doubted) ||
         std::ranges::any_of(comparison.faces[visit], doubted);
}

std::string verdict_words(const Comparison& comparison, const MeasureOverVisits& one,
                          std::size_t visit) {
  return words_of(one.changes[visit]->beyond) +
         (is_doubtful(comparison, one, visit) ? ", doubtful" : "");
}

std::vector<std::string> remarks(const Comparison& comparison) {
  std::vector<std::string> all;
  if (!comparison.file.order_remark.empty()) all.push_back(comparison.file.order_remark);
  add_each_once(comparison.scan_remarks, all);
  for (const auto& visit : comparison.faces)
    for (const MeasuredFace& face : visit) {
      const bool between =
          &visit != &comparison.faces.front() && &visit != &comparison.faces.back();
      if (between) add_each_once(face.doubts, all);
      add_each_once(face.remarks, all);
    }
  return all;
}

std::vector<std::string> choices(const Comparison& comparison) {
  std::vector<std::string> all;
  for (const auto& visit : comparison.faces)
    for (const MeasuredFace& face : visit) add_each_once(face.choices, all);
  return all;
}

}  // namespace hyperex::visits
