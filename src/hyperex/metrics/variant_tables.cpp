// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/variant_tables.hpp"

#include <fmt/format.h>
#include <fmt/ostream.h>

#include <cmath>

#include "hyperex/core/files.hpp"
#include "hyperex/io/csv_cells.hpp"

namespace hyperex::metrics {
namespace {

std::string cell(double value) {
  return std::isfinite(value) ? fmt::format("{:.6g}", value) : std::string();
}

/// The figures of a row, with their names in variants.csv and summary.json.
std::vector<std::pair<const char*, double>> figures_of(const VariantComparison& c) {
  return {{"greatest_displacement_mm", c.greatest_displacement_mm},
          {"greatest_distance_mm", c.greatest_distance_mm},
          {"displacement_there_mm", c.displacement_there_mm},
          {"base_displacement_there_mm", c.base_displacement_there_mm},
          {"rms_distance_at_peak_mm", c.rms_distance_mm},
          {"mean_change_at_peak_mm", c.mean_change_mm},
          {"mean_displacement_R_mm", c.mean_displacement_right_mm},
          {"mean_displacement_L_mm", c.mean_displacement_left_mm},
          {"commissure_R_mm", c.commissure_right.to_mm},
          {"commissure_L_mm", c.commissure_left.to_mm},
          {"commissure_R_change_mm", c.commissure_right.change_mm()},
          {"commissure_L_change_mm", c.commissure_left.change_mm()},
          {"commissure_R_band_mm", c.commissure_right.band_mm},
          {"commissure_L_band_mm", c.commissure_left.band_mm},
          {"commissure_R_decided", c.commissure_right.decided()},
          {"commissure_L_decided", c.commissure_left.decided()},
          {"commissure_R_from_base_mm", c.right_from_base.most_mm},
          {"commissure_R_from_base_s", c.right_from_base.time_s},
          {"commissure_L_from_base_mm", c.left_from_base.most_mm},
          {"commissure_L_from_base_s", c.left_from_base.time_s},
          {"commissure_R_along_base_mm", c.right_along_base.to_mm},
          {"commissure_L_along_base_mm", c.left_along_base.to_mm},
          {"commissure_R_along_base_band_mm", c.right_along_base.band_mm},
          {"commissure_L_along_base_band_mm", c.left_along_base.band_mm},
          {"commissure_R_along_base_decided", c.right_along_base.decided()},
          {"commissure_L_along_base_decided", c.left_along_base.decided()},
          {"asymmetry_rms_mm", c.asymmetry_mm},
          {"added_xi_difference", c.added_xi_difference},
          {"added_xi_floor", c.added_xi_floor},
          {"added_xi_decided", c.added_xi_decided()},
          {"share_within_25_mm_of_mouth", c.share_near_mouth},
          {"lag_ms", 1e3 * c.lag.lag_s},
          {"lag_correlation", c.lag.correlation},
          {"hysteresis", c.hysteresis},
          {"symmetry_integral_s", c.symmetry_integral_s}};
}

}  // namespace

void write_variants_csv(const std::filesystem::path& file, const VariantComparison& base,
                        const std::vector<VariantComparison>& compared, const ResponsePair& pair) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "variant";
    for (const auto& figure : figures_of(base)) out << ',' << figure.first;
    out << ",farthest_near,driven_point,response_point,jitter_known\n";
    const auto row = [&](const VariantComparison& c) {
      out << io::in_quotes_where_needed(c.name);
      for (const auto& figure : figures_of(c)) out << ',' << cell(figure.second);
      fmt::print(out, ",{},{},{},{:d}\n", io::in_quotes_where_needed(c.farthest_near),
                 io::in_quotes_where_needed(pair.driven), io::in_quotes_where_needed(pair.response),
                 c.jitter_known);
    };
    row(base);
    for (const auto& one : compared) row(one);
  });
}

void write_variant_excursions_csv(const std::filesystem::path& file, const Excursions& base,
                                  const std::vector<NamedExcursions>& variants) {
  write_file_atomically(file, [&](std::ostream& out) {
    out << "variant,point,side,base_mm,variant_mm,change_mm,band_mm,decided,jitter_known\n";
    for (const NamedExcursions& variant : variants)
      for (std::size_t i = 0; i < base.pairs.size(); ++i)
        for (const Side side : {Side::right, Side::left}) {
          const PairExcursion& pair = variant.excursions.pairs.at(i);
          const auto change = change_of(base.pairs[i], pair, side);
          fmt::print(out, "{},{},{},{},{},{},{},{},{:d}\n",
                     io::in_quotes_where_needed(variant.name),
                     io::in_quotes_where_needed(pair.name), side == Side::left ? 'L' : 'R',
                     cell(change.from_mm), cell(change.to_mm), cell(change.change_mm()),
                     cell(change.band_mm), cell(change.decided()),
                     base.pairs[i].known.jitter && pair.known.jitter);
        }
  });
}

nlohmann::ordered_json json_of(const VariantComparison& c) {
  nlohmann::ordered_json json;
  json["name"] = c.name;
  for (const auto& [name, value] : figures_of(c)) json[name] = value;  // NaN is written as null
  json["farthest_near"] = c.farthest_near;
  json["jitter_known"] = c.jitter_known;
  return json;
}

}  // namespace hyperex::metrics
