// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/run/variants.hpp"

namespace hyperex::run {
using namespace scene;
using namespace session;
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

TEST(GainsHardlyKnown, NamesAMuscleThatTheRecordingUsesLessThanItIsKnown) {
  simulate::MuscleCourse base;
  base.names = {"zyg_major_L", "zyg_major_R"};
  base.activation = Eigen::MatrixXd{{0, 0.9}, {0.1, 0.2}};
  base.sigma = Eigen::MatrixXd{{0.3, 0.3}, {0.4, 0.42}};
  std::vector<VariantRun> runs(4);
  const char* names[] = {"tissue alone", "weak right", "weak left", "weak both"};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].scene.title = names[i];
    runs[i].simulation.performance.muscles = base;
  }
  const auto weaken = [&](std::size_t run, Eigen::Index muscle) {
    runs[run].simulation.performance.muscles.activation.row(muscle) *= 0.3;
  };
  weaken(1, 1);
  weaken(2, 0);
  weaken(3, 0);
  weaken(3, 1);
  EXPECT_THAT(
      gains_hardly_known(base, runs),
      ElementsAre(StartsWith("variant weak right: in this recording zyg_major_R is active by "
                             "at most 0.20 +- 0.42")));
  EXPECT_THAT(gains_hardly_known({}, runs), ElementsAre());
}

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

TEST(LipsThatPass, AreToldOfVariantsBeyondBase) {
  std::vector<VariantRun> runs(4);
  const double overlap_mm[] = {0.4, 0.6, 1.4, 2};
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].scene.title = "v" + std::to_string(i);
    runs[i].simulation.report.lip_overlap_mm = overlap_mm[i];
  }
  EXPECT_THAT(lips_that_pass(runs, 0),
              ElementsAre(StartsWith("variant v1: "), StartsWith("variant v2: "),
                          HasSubstr("by up to 2.0 mm (0.0 mm in base)")));
  EXPECT_THAT(lips_that_pass(runs, 1.35), ElementsAre(StartsWith("variant v3: ")))
      << "what base does too is told once";
  EXPECT_THAT(lips_that_pass({}, 3), ElementsAre());
}

}  // namespace
}  // namespace hyperex::run
