// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/output/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/scene/run/variants.hpp"

namespace hyperex::scene {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::StartsWith;

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
}  // namespace hyperex::scene
