// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/uncertainty/budget_outputs.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "hyperex/core/files.hpp"
#include "hyperex/core/held_against.hpp"
#include "hyperex/io/csv_cells.hpp"

namespace hyperex::uncertainty {
namespace {

using metrics::ErrorPart;
using Json = nlohmann::ordered_json;

/// Those that a run of a face has.
constexpr std::array kParts = {ErrorPart::jitter,    ErrorPart::head_pose, ErrorPart::landmarks,
                               ErrorPart::mesh,      ErrorPart::muscles,   ErrorPart::inversion,
                               ErrorPart::stiffness, ErrorPart::law,       ErrorPart::repetition};

std::string name_of(FigureKind kind) {
  if (kind == FigureKind::excursion) return "excursion";
  return kind == FigureKind::difference ? "difference" : "change";
}

std::string side_of(const BudgetedFigure& figure) {
  return figure.side ? std::string(1, figure.side) : "";
}

std::string cell(double mm) {
  return std::isfinite(mm) ? fmt::format("{:.6g}", mm) : std::string();
}

std::string decided_of(const BudgetedFigure& figure) {
  const std::optional<bool> decided = figure.decided();
  if (figure.kind == FigureKind::excursion || !decided) return "";
  return *decided ? "1" : "0";
}

/// "jitter"; empty where all parts are known.
std::string unknown_part(const BudgetedFigure& figure) {
  return figure.jitter_known ? "" : metrics::name_of(ErrorPart::jitter);
}

/// NaN where it is not known.
double part_mm(const BudgetedFigure& figure, ErrorPart part) {
  return part == ErrorPart::jitter && !figure.jitter_known ? std::nan("")
                                                           : figure.errors.half_width_95(part);
}

std::string column_of(ErrorPart part) {
  std::string name = metrics::name_of(part);
  std::ranges::replace(name, ' ', '_');
  return name + "_mm";
}

/// "mesh"; empty where no part is known.
std::string largest_known_part(const BudgetedFigure& figure) {
  return figure.errors.variance() > 0 ? metrics::name_of(figure.errors.largest()) : "";
}

/// Empty also where a part that is not known may be the largest.
std::string largest_part(const BudgetedFigure& figure) {
  return figure.jitter_known ? largest_known_part(figure) : "";
}

Json json_of(const BudgetedFigure& figure) {
  Json json;
  if (!figure.variant.empty()) json["variant"] = figure.variant;
  json["figure"] = name_of(figure.kind);
  if (figure.side) json["side"] = side_of(figure);
  json["value_mm"] = figure.value_mm;
  json["shown_mm"] = figure.shown_mm();
  const double half_mm = figure.half_width_95_mm();  // NaN: a part is not known
  json["half_width_95_mm"] = std::isnan(half_mm) ? Json() : Json(half_mm);
  json["known_half_width_95_mm"] = figure.known_half_width_95_mm();
  if (figure.kind != FigureKind::excursion)
    json["decided"] = figure.decided() ? Json(*figure.decided()) : Json();
  json["largest_part"] = largest_part(figure);
  json["unknown_part"] = unknown_part(figure);
  for (const ErrorPart part : kParts)
    json["parts_mm"][metrics::name_of(part)] = part_mm(figure, part);  // NaN is written as null
  return json;
}

/// Without the sign of a zero.
std::string rounded_mm(double mm) {
  return fmt::format("{:.1f}", printed_mm(mm) + 0.0);
}

/// "-3.2 mm (95 %: -4.6 to -1.8; mostly muscles)", or "-3.2 mm (at least +- 1.4; mostly muscles),
/// cannot tell" where the jitter is not known. The value agrees with the printed excursions. The
/// ends are those of the exact interval, and contain the value as it is printed.
std::string interval_words(const BudgetedFigure& figure) {
  const double half = figure.known_half_width_95_mm(), shown = figure.shown_mm();
  const double low = std::min(figure.value_mm - half, shown),
               high = std::max(figure.value_mm + half, shown);
  const std::string interval =
      figure.jitter_known ? fmt::format("95 %: {} to {}", rounded_mm(low), rounded_mm(high))
                          : fmt::format("at least +- {}", rounded_mm(half));
  const std::string part = largest_known_part(figure);
  const std::string words = fmt::format("{} mm ({}{})", rounded_mm(shown), interval,
                                        part.empty() ? "" : "; mostly " + part);
  if (figure.kind == FigureKind::excursion) return words;
  const std::optional<bool> decided = figure.decided();
  if (!decided) return words + ", cannot tell";
  return *decided ? words : words + ", undecided";
}

std::string words_of_side(char side) {
  return side == 'R' ? "right" : "left";
}

}  // namespace

void write_budget_csv(const std::filesystem::path& file, const FaceBudget& budget) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "variant,point,side,figure,value_mm,half_width_95_mm,decided,largest_part";
    for (const ErrorPart part : kParts) out << ',' << column_of(part);
    out << ",known_half_width_95_mm,unknown_part\n";
    for (const BudgetedFigure& figure : budget.figures) {
      fmt::print(out, "{},{},{},{},{},{},{},{}", io::in_quotes_where_needed(figure.variant),
                 io::in_quotes_where_needed(figure.point), side_of(figure), name_of(figure.kind),
                 cell(figure.value_mm), cell(figure.half_width_95_mm()), decided_of(figure),
                 largest_part(figure));
      for (const ErrorPart part : kParts) fmt::print(out, ",{}", cell(part_mm(figure, part)));
      fmt::print(out, ",{},{}\n", cell(figure.known_half_width_95_mm()), unknown_part(figure));
    }
  });
}

std::vector<std::string> corner_sentences(const FaceBudget& budget) {
  std::vector<std::string> out;
  for (const BudgetedFigure& figure : budget.figures) {
    if (figure.point != budget.corners || std::isnan(figure.value_mm)) continue;
    if (figure.kind == FigureKind::difference)
      out.push_back("corners of the mouth, left less right: " + interval_words(figure));
    else if (figure.kind == FigureKind::excursion)
      out.push_back(fmt::format("{} corner of the mouth: {}", words_of_side(figure.side),
                                interval_words(figure)));
    else
      out.push_back(fmt::format("{}: the {} corner of the mouth changes by {}", figure.variant,
                                words_of_side(figure.side), interval_words(figure)));
  }
  if (out.empty()) return out;
  for (const std::string& missing : budget.missing)
    out.push_back("these intervals lack a part that could not be simulated: " + missing);
  if (!budget.jitter_known)
    out.push_back(
        "the recording's jitter is not known, so each +- is only a lower bound; output.jitter_mm "
        "states the jitter, 0 for exact points");
  return out;
}

Json budget_json(const FaceBudget& budget) {
  Json json;
  json["assumed"] = budget.assumed;
  json["missing"] = budget.missing;
  json["jitter_known"] = budget.jitter_known;
  Json corners = Json::array();
  for (const BudgetedFigure& figure : budget.figures)
    if (figure.point == budget.corners) corners.push_back(json_of(figure));
  json["corners_of_the_mouth"] = corners;
  json["sentences"] = corner_sentences(budget);
  return json;
}

}  // namespace hyperex::uncertainty
