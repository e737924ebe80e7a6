// SPDX-License-Identifier: GPL-3.0-or-later
// The demo's summary against values kept in demo_summary.json, and two runs against each other.
// After a change that is meant to move the numbers:
//   ctest --test-dir build/release -R golden.run_demo
//   HYPEREX_GOLDEN_UPDATE=1 build/release/bin/test_golden
// writes the new values into the file (its tolerances and reasons stay); look at the difference.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "hyperex/core/files.hpp"
#include "hyperex/io/csv.hpp"

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

/// What the run gave: a path into summary.json, or the greatest value of a column of a table.
double measured(const Json& summary, const std::string& key) {
  if (const auto in = key.find(" of "); in != std::string::npos)
    return greatest(kRuns / "demo" / key.substr(in + 4), key.substr(0, in));
  return summary.at(Json::json_pointer("/" + key)).get<double>();
}

TEST(Demo, GivesTheNumbersKept) {
  const Json summary = Json::parse(read_file(kRuns / "demo" / "summary.json"));
  Json golden = Json::parse(read_file(HYPEREX_GOLDEN_FILE));
  ASSERT_GE(golden.at("values").size(), 10u);
  const bool update = std::getenv("HYPEREX_GOLDEN_UPDATE") != nullptr;
  for (auto& [key, kept] : golden.at("values").items()) {
    const double value = measured(summary, key);
    EXPECT_FALSE(kept.at("why").get<std::string>().empty()) << key;
    if (update)
      kept["value"] = std::round(1e4 * value) / 1e4;
    else
      EXPECT_NEAR(value, kept.at("value").get<double>(), kept.at("tolerance").get<double>()) << key;
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

TEST(Demo, LeavesAllItsFiles) {
  for (const char* file : {"performance.glb", "frames.pvd", "frames/frame_0080.vtu", "report.html",
                           "asymmetry.png", "excursions.csv"})
    EXPECT_GT(fs::file_size(kRuns / "demo" / file), 1000u) << file;
}

}  // namespace
}  // namespace hyperex
