// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "hyperex/io/csv.hpp"
#include "hyperex/run/gaze_table.hpp"
#include "support/test_file.hpp"

namespace hyperex::run {
namespace {
using testing::ElementsAre;

TEST(ShownTimes, AreThoseWantedWhereTheRunIsLongEnough) {
  EXPECT_THAT(shown_times_s({0, 0.7, 2.7}, 2.7), ElementsAre(0, 0.7, 2.7));
}

TEST(ShownTimes, ShowTheEndOnceForAllThatIsWantedLater) {
  EXPECT_THAT(shown_times_s({0, 0.7, 1.3, 2.7}, 0.9), ElementsAre(0, 0.7, 0.9));
  EXPECT_THAT(shown_times_s({0, 0.7, 1.3, 2.7}, 0.7), ElementsAre(0, 0.7));
  EXPECT_THAT(shown_times_s({5}, 0.2), ElementsAre(0.2));
}

TEST(SpreadFrames, HoldBothEndsAndThePeak) {
  EXPECT_THAT(spread_frames(81, 39), ElementsAre(0, 20, 39, 60, 80));
  EXPECT_THAT(spread_frames(81, 3), ElementsAre(0, 3, 40, 60, 80));
  EXPECT_THAT(spread_frames(81, 0), ElementsAre(0, 20, 40, 60, 80));
  EXPECT_THAT(spread_frames(81, 80), ElementsAre(0, 20, 40, 60, 80));
  EXPECT_THAT(spread_frames(2, 1), ElementsAre(0, 1));
  EXPECT_THAT(spread_frames(1, 0), ElementsAre(0));
}

TEST(GazeTable, HasTheDegreesOfEitherEyeInEachFrame) {
  simulate::Performance performance;
  performance.frame_time_s = {0, 0.5};
  performance.gaze = {{}, {.right = {.up_rad = 0.1, .left_rad = -0.2}, .left = {.up_rad = 0.3}}};
  const auto file = test_file("gaze_table_test.csv");
  write_gaze_csv(file, performance);
  const io::CsvTable table = io::read_csv(file);
  EXPECT_THAT(table.names, ElementsAre("time_s", "eye_yaw_R_deg", "eye_pitch_R_deg",
                                       "eye_yaw_L_deg", "eye_pitch_L_deg"));
  ASSERT_EQ(table.values.rows(), 2);
  EXPECT_TRUE(table.values.row(0).isZero());
  constexpr double rad_deg = 180 / std::numbers::pi;
  Eigen::RowVectorXd second(5);
  second << 0.5, -0.2 * rad_deg, 0.1 * rad_deg, 0, 0.3 * rad_deg;
  EXPECT_TRUE(table.values.row(1).isApprox(second, 1e-12)) << table.values;
}

}  // namespace
}  // namespace hyperex::run
