// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/tables.hpp"

#include <stdexcept>

#include "hyperex/core/carried_file.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::expression {

namespace {
[[noreturn]] void damaged() {
  throw std::logic_error("a table of the face models inside this program is damaged");
}
}  // namespace

HX_CARRIED_FILE(canonical_units_table, HYPEREX_MODEL_DATA "/canonical_units.csv")
HX_CARRIED_FILE(canonical_landmarks_table, HYPEREX_MODEL_DATA "/canonical_landmarks.csv")
HX_CARRIED_FILE(network_points_table, HYPEREX_MODEL_DATA "/network_points.csv")
HX_CARRIED_FILE(candide_pairs_table, HYPEREX_MODEL_DATA "/candide_pairs.csv")
HX_CARRIED_FILE(candide_landmarks_table, HYPEREX_MODEL_DATA "/candide_landmarks.csv")
HX_CARRIED_FILE(candide_units_table, HYPEREX_MODEL_DATA "/candide_units.csv")
HX_CARRIED_FILE(openface_arkit_table, HYPEREX_MODEL_DATA "/openface_arkit.csv")
HX_CARRIED_FILE(expression_shapes_table, HYPEREX_MODEL_DATA "/expression_shapes.csv")
HX_CARRIED_FILE(expression_couplings_table, HYPEREX_MODEL_DATA "/expression_couplings.csv")

std::vector<std::vector<std::string>> table_rows(std::string_view text, std::string_view header) {
  std::vector<std::vector<std::string>> rows;
  io::Lines lines(text);
  for (std::string_view line; lines.next(line);) {
    line = io::trimmed(line);
    if (line.empty() || line.front() == '#' || line == header) continue;
    std::vector<std::string> cells;
    for (const auto cell : io::split(line, ',')) cells.emplace_back(io::trimmed(cell));
    rows.push_back(std::move(cells));
  }
  return rows;
}

double table_number(const std::string& cell) {
  const auto value = io::parse_number(cell);
  if (!value) damaged();
  return *value;
}

std::vector<int> table_indices(const std::string& cell, int end) {
  std::vector<int> indices;
  for (const auto word : io::words(cell)) {
    const auto value = io::parse_integer(word);
    if (!value || *value < 0 || *value >= end) damaged();
    indices.push_back(int(*value));
  }
  if (indices.empty()) damaged();
  return indices;
}

}  // namespace hyperex::expression
