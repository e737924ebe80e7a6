// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/landmarks.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>

#include "unit/io/io_testing.hpp"

namespace hyperex::io {
namespace {
using testing::expect_refused;
using LandmarkFile = testing::FileTest;

TEST_F(LandmarkFile, RoundTripInEachUnit) {
  const Landmarks landmarks = {{"cheilion_L", {0.0291234567890123, -0.04, 0.08}},
                               {"pronasale", {1e-9, 0.1 / 3, 0.11}}};
  for (const LengthUnit unit :
       {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre}) {
    write_landmarks(path("l.json"), landmarks, unit);
    const Landmarks read = read_landmarks(path("l.json"));
    ASSERT_EQ(read.size(), 2u);
    for (const auto& [name, p] : landmarks) EXPECT_LT((read.at(name) - p).norm(), 1e-15);
  }
}

/// Requirements of 3D Slicer's markups schema 1.0.3, and of its reader, on a list of points.
void expect_slicer_schema(const nlohmann::json& root) {
  ASSERT_TRUE(root.at("@schema").is_string());
  EXPECT_TRUE(std::regex_match(root["@schema"].get<std::string>(),
                               std::regex(".*markups-schema-v1\\.[0-9]+\\.[0-9]+\\.json#*")));
  ASSERT_EQ(root.at("markups").size(), 1u);
  const auto& markup = root["markups"][0];
  EXPECT_EQ(markup.at("type"), "Fiducial");
  EXPECT_EQ(markup.at("coordinateSystem"), "LPS");
  const auto& unit = markup.at("coordinateUnits");
  if (unit.is_array()) {  // a coded entry
    ASSERT_EQ(unit.size(), 3u);
    EXPECT_EQ(unit[1], "UCUM");
  } else {
    EXPECT_EQ(unit, "mm");  // the only word besides um
  }
  for (const char* flag : {"locked", "fixedNumberOfControlPoints"})
    EXPECT_TRUE(markup.at(flag).is_boolean()) << flag;
  std::set<std::string> ids;
  for (const auto& point : markup.at("controlPoints")) {
    EXPECT_TRUE(ids.insert(point.at("id").get<std::string>()).second);
    EXPECT_TRUE(point.at("label").is_string());
    ASSERT_EQ(point.at("position").size(), 3u);
    ASSERT_EQ(point.at("orientation").size(), 9u);
    for (const auto& part : {point["position"], point["orientation"]})
      for (const auto& number : part) EXPECT_TRUE(number.is_number());
    for (const char* flag : {"selected", "locked", "visibility"})
      EXPECT_TRUE(point.at(flag).is_boolean()) << flag;
    EXPECT_EQ(point.at("positionStatus"), "defined");
  }
}

TEST_F(LandmarkFile, WritesSlicersPointListWhereTheNameSaysSo) {
  const Landmarks landmarks = {{"cheilion_L", {0.0291234567890123, -0.04, 0.08}},
                               {"pronasale", {1e-9, 0.1 / 3, 0.11}}};
  for (const LengthUnit unit :
       {LengthUnit::millimetre, LengthUnit::centimetre, LengthUnit::metre}) {
    write_landmarks(path("l.mrk.json"), landmarks, unit);
    std::ifstream in(path("l.mrk.json"));
    const auto root = nlohmann::json::parse(in);
    expect_slicer_schema(root);
    // The numbers are the scan's own: Slicer takes both files as they are.
    const auto& point = root["markups"][0]["controlPoints"][0];
    EXPECT_EQ(point["label"], "cheilion_L");
    EXPECT_NEAR(point["position"][1].get<double>(), -0.04 / metres_per(unit), 1e-12);
    const Landmarks read = read_landmarks(path("l.mrk.json"));
    ASSERT_EQ(read.size(), 2u);
    for (const auto& [name, p] : landmarks) EXPECT_LT((read.at(name) - p).norm(), 1e-15);
  }
  write_landmarks(path("l.json"), landmarks, LengthUnit::millimetre);
  std::ifstream in(path("l.json"));
  EXPECT_FALSE(nlohmann::json::parse(in).contains("markups"));
}

TEST_F(LandmarkFile, StatedUnitGoesBeforeTheFiles) {
  const auto file = write("l.json", R"({"units": "mm", "points": {"a": [1, 2, 3]}})");
  EXPECT_NEAR(read_landmarks(file).at("a").z(), 0.003, 1e-15);
  EXPECT_NEAR(read_landmarks(file, LengthUnit::centimetre).at("a").z(), 0.03, 1e-15);
  const auto bare = write("b.json", R"({"points": {"a": [1, 2, 3]}})");
  EXPECT_NEAR(read_landmarks(bare, LengthUnit::metre).at("a").z(), 3, 1e-15);
  expect_refused(bare, "units: expected \"mm\", \"cm\" or \"m\"", [&] { read_landmarks(bare); });
}

std::string slicer(const std::string& system, const std::string& more = "") {
  return R"({"markups": [{"type": "Fiducial", "coordinateSystem": ")" + system +
         R"(", "coordinateUnits": "mm", "controlPoints": [
    {"id": "1", "label": "pronasale", "position": [1, 2, 3], "positionStatus": "defined"},
    {"id": "2", "label": "not yet", "position": [0, 0, 0], "positionStatus": "undefined"})" +
         more + "]}]}";
}

TEST_F(LandmarkFile, SlicerInBothSystems) {
  const Landmarks lps = read_landmarks(write("a.mrk.json", slicer("LPS")));
  ASSERT_EQ(lps.size(), 1u);
  EXPECT_EQ(lps.at("pronasale"), Vec3(0.001, 0.002, 0.003));
  EXPECT_EQ(read_landmarks(write("b.mrk.json", slicer("RAS"))).at("pronasale"),
            Vec3(-0.001, -0.002, 0.003));
}

TEST_F(LandmarkFile, RefusesEachFaultWithOneLine) {
  const std::string head = R"({"units": "mm", "points": )";
  const std::vector<std::pair<std::string, std::string>> faults = {
      {"", "is no sound JSON"},
      {R"({"units": "mm", "points": {"a": [1, 2)", "is no sound JSON: parse error at line 1"},
      {head + R"({"a": [1, 2, NaN]}})", "is no sound JSON"},
      {head + R"({"a": [1, 2, 1e999]}})", "is no sound JSON"},
      {head + R"({"a": [1, 2, null]}})", "a = [1,2,null]: expected three finite numbers"},
      {head + R"({"a": [1, 2]}})", "a = [1,2]: expected three finite numbers"},
      {head + R"({"a": "x"}})", "three finite numbers"},
      {head + R"({"a": [1, 2, 3], "a": [1, 2, 4]}})", "a: expected each name once"},
      {head + R"({"": [1, 2, 3]}})", "a point has no name"},
      {head + "{}}", "has no points"},
      {head + "[1]}", "points: expected an object"},
      {R"({"units": "inch", "points": {"a": [1, 2, 3]}})", "units = \"inch\""},
      {R"({"units": 3, "points": {"a": [1, 2, 3]}})", "units = 3"},
      {R"([1, 2])", "neither \"points\" nor"},
      {R"({"markups": 5})", "markups: expected a list"},
      {R"({"markups": [5]})", "objects in this list"},
      {R"({"markups": [{"controlPoints": []}]})", "has no points"},
      {R"({"markups": [{"controlPoints": [{"position": [1, 2, 3]}]}]})", "a label each"},
      {slicer("XYZ"), "\"LPS\" or \"RAS\""},
      {slicer("LPS", R"(, {"label": "pronasale", "position": [1, 2, 4]})"), "each name once"},
      {slicer("LPS", R"(, {"label": "b", "position": [1, 2]})"), "b = [1,2]"},
  };
  for (const auto& [text, part] : faults) {
    const auto file = write("bad.json", text);
    expect_refused(file, part, [&] { read_landmarks(file); });
  }
}

TEST_F(LandmarkFile, TornAnywhereIsRefused) {
  const std::string text = slicer("LPS");
  for (std::size_t length = 0; length < text.size(); ++length)
    EXPECT_THROW(read_landmarks(write("torn.json", text.substr(0, length))), InputError) << length;
}

}  // namespace
}  // namespace hyperex::io
