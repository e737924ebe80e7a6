// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace hyperex::run
