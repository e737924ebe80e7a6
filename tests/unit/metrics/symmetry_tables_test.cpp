// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/symmetry_tables.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "hyperex/core/files.hpp"
#include "hyperex/metrics/repetition_floor.hpp"
#include "hyperex/metrics/symmetry_json.hpp"

namespace hyperex::metrics {
namespace {
using ::testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

SymmetryMeasures some() {
  SymmetryMeasures all;
  all.curve.time_s = {0, 0.1, 0.2};
  all.curve.xi_left = {0, nan, 0.5};
  all.curve.xi_right = {0, 0, 0.25};
  all.curve.s = {std::log(0.5), nan, std::log(0.25)};
  all.curve.floor = 0.5;
  PairExcursion pair;
  pair.name = "cheilion";
  pair.left = 0;
  pair.right = 1;
  pair.left_side = {4, 8, 20};
  pair.right_side = {2, 4, 5};
  pair.excursion_ratio = 0.5;
  pair.path_ratio = 0.5;
  pair.speed_ratio = 0.25;
  pair.speed_correlation = nan;
  all.excursions.pairs = {pair};
  all.excursions.commissure.left = 0;
  all.excursions.commissure.left_mm = {0, nan, 4};
  return all;
}

class SymmetryTables : public ::testing::Test {
 protected:
  void TearDown() override { std::filesystem::remove(file_); }
  std::filesystem::path file_ =
      std::filesystem::path(::testing::TempDir()) /
      (std::string("hyperex_symmetry_tables_") +
       ::testing::UnitTest::GetInstance()->current_test_info()->name() + ".csv");
};

TEST_F(SymmetryTables, CurvesOfAnExactMotionHaveNoNoiseFloor) {
  write_symmetry_csv(file_, some());
  EXPECT_EQ(
      read_file(file_),
      "time_s,xi_R,xi_L,S_ln,floor,S_floor,S_floor_jitter,S_floor_mesh,decided,commissure_R_mm,"
      "commissure_L_mm,commissure_speed_R_mm_s,commissure_speed_L_mm_s\n"
      "0,0,0,-0.693147181,0.5,,,,,,0,,\n0.1,0,,,0.5,,,,,,,,\n"
      "0.2,0.25,0.5,-1.38629436,0.5,,,,,,4,,\n");
}

TEST_F(SymmetryTables, CurvesHoldTheNoiseFloorAndTheMap) {
  SymmetryMeasures all = some();
  all.curve.noise = {1, 1, 0.5};
  all.map.emplace();
  all.map->frames = {{0, 0, 0, 0}, {1, 2, 3, 4}, {1, nan, 3, 4}};
  write_symmetry_csv(file_, all);
  const std::string text = read_file(file_);
  EXPECT_THAT(text, HasSubstr(",asymmetry_face_rms_mm,asymmetry_face_p95_mm,asymmetry_mouth_rms_mm,"
                              "asymmetry_mouth_p95_mm\n"));
  EXPECT_THAT(text, HasSubstr("\n0.1,0,,,0.5,0,0,,0,,,,,1,2,3,4\n"));
  EXPECT_THAT(text, HasSubstr(",-0.693147181,-0.693147181,,0,,4,,,1,,3,4\n"));
}

TEST_F(SymmetryTables, TheLargerOfBothFloorsDecides) {
  SymmetryMeasures all = some();
  all.curve.noise = {1, 1, 0.1};
  all.curve.mesh_noise = {0.1, 0.1, 0.2};
  EXPECT_EQ(all.curve.floors(), (std::vector<double>{1, 1, 0.2}));
  EXPECT_FALSE(all.curve.undecided(2)) << "0.25 apart";
  all.curve.mesh_noise[2] = 0.3;
  EXPECT_TRUE(all.curve.undecided(2));
  all.curve.noise.clear();
  all.curve.floor = 1e-6;
  EXPECT_TRUE(all.curve.undecided(2)) << "the mesh alone";
  EXPECT_THAT(verdict_of(all.curve), HasSubstr("the mesh alone"));
  write_symmetry_csv(file_, all);
  EXPECT_THAT(read_file(file_), HasSubstr(",1e-06,-1.2039728,,-1.2039728,0,,4,,\n"));
  const auto json = summary_of(all);
  EXPECT_EQ(json["mesh_floor"]["xi_there"], 0.3);
  EXPECT_NEAR(json["S_floor_there"].get<double>(), std::log(0.3), 1e-12);
  all.curve.mesh_noise.clear();
  all.no_mesh_floor = "for a reason";
  EXPECT_EQ(summary_of(all)["mesh_floor"]["why"], "for a reason");
}

TEST_F(SymmetryTables, ExcursionsAreARowAPair) {
  write_excursions_csv(file_, some().excursions);
  EXPECT_EQ(read_file(file_),
            "point,excursion_R_mm,excursion_L_mm,excursion_ratio_R_L,path_R_mm,path_L_mm,"
            "path_ratio_R_L,peak_speed_R_mm_s,peak_speed_L_mm_s,peak_speed_ratio_R_L,"
            "speed_correlation,difference_mm,jitter_floor_mm,mesh_floor_mm,pose_floor_mm,"
            "repetition_floor_mm,floor_mm,decided,"
            "path_floor_mm,peak_speed_floor_mm_s,path_decided,peak_speed_decided,"
            "speed_correlation_decided\n"
            "cheilion,2,4,0.5,4,8,0.5,5,20,0.25,,2,0,,0,0,0,1,0,0,1,1,1\n");
}

TEST_F(SymmetryTables, NothingAboveTheFloorsIsDecidedWhereNoiseIsNotKnown) {
  SymmetryMeasures all = some();
  set_known(all.excursions, {.jitter = false, .head = false});
  write_excursions_csv(file_, all.excursions);
  EXPECT_THAT(read_file(file_), HasSubstr(",0.25,,2,,,,0,,,,,,,\n"));
  auto json = summary_of(all);
  EXPECT_EQ(json["jitter_known"], false);
  for (const char* key :
       {"undecided", "path_undecided", "peak_speed_undecided", "speed_correlation_undecided",
        "jitter_floor_mm", "pose_floor_mm", "path_floor_mm", "peak_speed_floor_mm_s", "floor_mm"})
    EXPECT_TRUE(json["commissure"].at(key).is_null()) << key;
  // More noise cannot decide what a known floor leaves undecided.
  add_repetition_floor(all.excursions, 3);
  write_excursions_csv(file_, all.excursions);
  EXPECT_THAT(read_file(file_), HasSubstr(",2,,,,3,3,0,,,,,\n"));
  EXPECT_EQ(summary_of(all)["commissure"]["undecided"], true);
  // No noise is seen in the points that hold the head.
  SymmetryMeasures unseen = some();
  set_known(unseen.excursions, {.jitter = false});
  unseen.excursions.pairs[0].pose_floor_mm = 7e-15;
  write_excursions_csv(file_, unseen.excursions);
  EXPECT_THAT(read_file(file_), HasSubstr(",0.25,,2,,,,0,,,,,,,\n"));
  EXPECT_TRUE(summary_of(unseen)["commissure"]["pose_floor_mm"].is_null());
  // The head's motion alone.
  set_known(all.excursions, {.head = false});
  add_repetition_floor(all.excursions, 0);
  write_excursions_csv(file_, all.excursions);
  EXPECT_THAT(read_file(file_), HasSubstr(",2,0,,,0,,,0,0,,,\n"));
  EXPECT_EQ(summary_of(all)["jitter_known"], true);
}

TEST_F(SymmetryTables, SummaryCallsUndecidedWhatNoiseMayMake) {
  SymmetryMeasures all = some();
  auto json = summary_of(all);
  EXPECT_EQ(json["undecided_samples"], 1);  // the one that was not measured
  EXPECT_TRUE(json["S_floor_there"].is_null());
  EXPECT_EQ(json["commissure"]["excursion_ratio_R_L"], 0.5);
  EXPECT_TRUE(json["commissure"]["speed_correlation"].is_null());
  all.curve.floor = 1e-6;
  EXPECT_THAT(verdict_of(all.curve), HasSubstr("at 0.2 s, by |xi_L - xi_R| = 0.25"));
  all.curve.noise = {0.3, 0.3, 0.3};
  EXPECT_THAT(verdict_of(all.curve), HasSubstr("undecided"));
  json = summary_of(all);
  EXPECT_EQ(json["undecided_samples"], 2);
  EXPECT_NEAR(json["S_floor_there"].get<double>(), std::log(0.3), 1e-12);
}

}  // namespace
}  // namespace hyperex::metrics
