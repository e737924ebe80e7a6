// SPDX-License-Identifier: GPL-3.0-or-later
// Compares the summaries of the demo and of examples/variants.toml with values kept in
// demo_summary.json, and two runs of the demo with each other. After an intended change of the
// numbers,
//   ctest --test-dir build/release -R 'golden.(run|first)'
//   HYPEREX_GOLDEN_UPDATE=1 build/release/bin/test_golden
// writes each value outside its tolerance into the file and empties its reason, which may no longer
// be true. Write a new reason: an empty one fails the test.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "hyperex/core/files.hpp"
#include "hyperex/io/csv.hpp"
#include "support/smile_muscles.hpp"

namespace hyperex {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

const fs::path kRuns = HYPEREX_GOLDEN_RUNS;

double greatest(const fs::path& csv, const std::string& column) {
  const io::CsvTable table = io::read_csv(csv);
  const auto c = std::find(table.names.begin(), table.names.end(), column) - table.names.begin();
  return table.values.col(c).maxCoeff();
}

/// The largest distance of a landmark of motion.csv from its position at rest (mm).
double travel_mm(const fs::path& run, const std::string& landmark) {
  const io::CsvTable table = io::read_csv(run / "motion.csv");
  const int x = table.column(landmark + "_x_mm");
  const auto place = table.values.middleCols(x, 3);
  return (place.rowwise() - place.row(0).eval()).rowwise().norm().maxCoeff();
}

/// What examples/variants.toml says of a variant: "NAME: FIGURE", as "stiffer: added_xi_floor".
double of_a_variant(const std::string& key) {
  const auto colon = key.find(": ");
  const std::string name = key.substr(0, colon), figure = key.substr(colon + 2);
  const Json summary = Json::parse(read_file(kRuns / "variants" / "summary.json"));
  for (const Json& row : summary.at("variants").at("table"))
    if (row.at("name") == name) return row.at(figure).get<double>();
  throw std::runtime_error("no variant " + name);
}

/// A result of a run: a path into summary.json, the greatest value of a column of a table ("xi_L of
/// symmetry.csv"), or the travel of a landmark ("travel_mm of cheek_L"). With the prefix "tet4: "
/// it is from the run with that element, with "variants: " from that of several variants.
double measured(std::string key) {
  if (const std::string variants = "variants: "; key.starts_with(variants))
    return of_a_variant(key.substr(variants.size()));
  fs::path run = kRuns / "demo";
  if (const std::string element = "tet4: "; key.starts_with(element)) {
    run = kRuns / "tet4";
    key = key.substr(element.size());
  }
  if (const std::string travel = "travel_mm of "; key.starts_with(travel))
    return travel_mm(run, key.substr(travel.size()));
  if (const auto in = key.find(" of "); in != std::string::npos)
    return greatest(run / key.substr(in + 4), key.substr(0, in));
  return Json::parse(read_file(run / "summary.json"))
      .at(Json::json_pointer("/" + key))
      .get<double>();
}

bool holds(const Json& kept, double value) {
  return std::abs(value - kept.at("value").get<double>()) <= kept.at("tolerance").get<double>();
}

/// The entry that replaces `kept` after a change of the numbers.
Json renewed(Json kept, double value) {
  if (holds(kept, value)) return kept;
  kept["value"] = std::round(1e4 * value) / 1e4;
  kept["why"] = "";
  return kept;
}

TEST(Golden, AValueThatChangesLosesItsReason) {
  const Json kept = {{"value", 2.5}, {"tolerance", 0.1}, {"why", "as measured"}};
  EXPECT_EQ(renewed(kept, 2.55), kept);
  EXPECT_EQ(renewed(kept, 2.71236), Json({{"value", 2.7124}, {"tolerance", 0.1}, {"why", ""}}));
}

TEST(Demo, GivesTheNumbersKept) {
  Json golden = Json::parse(read_file(HYPEREX_GOLDEN_FILE));
  ASSERT_GE(golden.at("values").size(), 10u);
  const char* wanted = std::getenv("HYPEREX_GOLDEN_UPDATE");
  const bool update = wanted && *wanted;  // an empty variable does not count
  for (auto& [key, kept] : golden.at("values").items()) {
    const double value = measured(key);
    if (update) kept = renewed(kept, value);
    EXPECT_TRUE(holds(kept, value)) << key << ": " << value << ", expected " << kept.at("value");
    EXPECT_FALSE(kept.at("why").get<std::string>().empty()) << key << ": why this value?";
  }
  if (update) std::ofstream(HYPEREX_GOLDEN_FILE) << golden.dump(2) << '\n';
}

TEST(Demo, GivesTheSameTwice) {
  for (const char* file : {"skin_peak.ply", "motion.csv", "symmetry.csv", "contact_sheet.png"}) {
    const std::string first = read_file(kRuns / "demo" / file);
    EXPECT_GT(first.size(), 1000u) << file;
    EXPECT_TRUE(first == read_file(kRuns / "again" / file)) << file << " differs";
  }
}

TEST(Demo, SmilesWithTheSmilesMuscle) {
  test::expect_zygomaticus_smiles(kRuns / "first_minute" / "activations.csv");
}

TEST(Demo, LeavesAllItsFiles) {
  for (const char* file : {"performance.glb", "frames.pvd", "frames/frame_0080.vtu", "report.html",
                           "asymmetry.png", "excursions.csv"})
    EXPECT_GT(fs::file_size(kRuns / "demo" / file), 1000u) << file;
}

}  // namespace
}  // namespace hyperex
