// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/tables.hpp"

#include <stdexcept>

#include "hyperex/io/number.hpp"

// Small tables, kept as files, copied into the library by the assembler.
#define HYPEREX_TABLE(symbol, file)                           \
  ".global hyperex_" symbol "_begin\n.global hyperex_" symbol \
  "_end\n"                                                    \
  "hyperex_" symbol "_begin:\n.incbin \"" file "\"\nhyperex_" symbol "_end:\n"
__asm__(".pushsection .rodata\n"  //
        HYPEREX_TABLE("canonical_units", HYPEREX_MODEL_DATA
                      "/canonical_units.csv") HYPEREX_TABLE("tracked_landmarks", HYPEREX_MODEL_DATA
                                                            "/canonical_landmarks.csv")
            HYPEREX_TABLE("network_points", HYPEREX_MODEL_DATA
                          "/network_points.csv") HYPEREX_TABLE("candide_pairs", HYPEREX_MODEL_DATA
                                                               "/candide_pairs.csv")
                HYPEREX_TABLE("candide_landmarks", HYPEREX_MODEL_DATA "/candide_landmarks.csv")
                    HYPEREX_TABLE("candide_units", HYPEREX_MODEL_DATA "/candide_units.csv")
                        HYPEREX_TABLE("openface_arkit", HYPEREX_MODEL_DATA
                                      "/openface_arkit.csv") HYPEREX_TABLE("expression_shapes",
                                                                           HYPEREX_MODEL_DATA
                                                                           "/expression_shapes.csv")
                            HYPEREX_TABLE("expression_couplings", HYPEREX_MODEL_DATA
                                          "/expression_couplings.csv") ".byte 0\n.popsection\n");

extern "C" const char hyperex_canonical_units_begin[], hyperex_canonical_units_end[],
    hyperex_tracked_landmarks_begin[], hyperex_tracked_landmarks_end[],
    hyperex_network_points_begin[], hyperex_network_points_end[], hyperex_candide_pairs_begin[],
    hyperex_candide_pairs_end[], hyperex_candide_landmarks_begin[], hyperex_candide_landmarks_end[],
    hyperex_candide_units_begin[], hyperex_candide_units_end[], hyperex_openface_arkit_begin[],
    hyperex_openface_arkit_end[], hyperex_expression_shapes_begin[],
    hyperex_expression_shapes_end[], hyperex_expression_couplings_begin[],
    hyperex_expression_couplings_end[];

namespace hyperex::expression {

namespace {
[[noreturn]] void damaged() {
  throw std::logic_error("a table of the face models inside this program is damaged");
}
}  // namespace

std::string_view canonical_units_table() {
  return {hyperex_canonical_units_begin, hyperex_canonical_units_end};
}
std::string_view canonical_landmarks_table() {
  return {hyperex_tracked_landmarks_begin, hyperex_tracked_landmarks_end};
}
std::string_view network_points_table() {
  return {hyperex_network_points_begin, hyperex_network_points_end};
}
std::string_view candide_pairs_table() {
  return {hyperex_candide_pairs_begin, hyperex_candide_pairs_end};
}
std::string_view candide_landmarks_table() {
  return {hyperex_candide_landmarks_begin, hyperex_candide_landmarks_end};
}
std::string_view candide_units_table() {
  return {hyperex_candide_units_begin, hyperex_candide_units_end};
}
std::string_view openface_arkit_table() {
  return {hyperex_openface_arkit_begin, hyperex_openface_arkit_end};
}
std::string_view expression_shapes_table() {
  return {hyperex_expression_shapes_begin, hyperex_expression_shapes_end};
}
std::string_view expression_couplings_table() {
  return {hyperex_expression_couplings_begin, hyperex_expression_couplings_end};
}

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
