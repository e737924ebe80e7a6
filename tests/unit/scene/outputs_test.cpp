// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/outputs.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hyperex::scene {
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

}  // namespace
}  // namespace hyperex::scene
