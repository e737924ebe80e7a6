// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/recording_jitter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace hyperex::session {
namespace {
using testing::HasSubstr;

motion::Motion of_samples(int count, double noise_m) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  motion::Motion motion;
  motion.names = {"a", "b", "c"};
  for (int k = 0; k < count; ++k) {
    motion.time_s.push_back(k / 30.0);
    Points at(3, 3);
    for (int i = 0; i < 9; ++i)
      at(i / 3, i % 3) = 0.01 * i + 0.005 * std::sin(k / 30.0 + i) + noise_m * normal(random);
    motion.positions.push_back(at);
  }
  return motion;
}

TEST(RecordedJitter, IsThatOfTheNoise) {
  const RecordedJitter found = recorded_jitter(of_samples(200, 3e-4));
  EXPECT_TRUE(found.known);
  EXPECT_NEAR(found.jitter_m, 3e-4, 0.4e-4);
}

TEST(RecordedJitter, IsUnknownWhereNoneShows) {
  const RecordedJitter found = recorded_jitter(of_samples(200, 0));
  EXPECT_FALSE(found.known);
  EXPECT_FALSE(found.too_short);
  EXPECT_EQ(found.jitter_m, 0);
  EXPECT_THAT(found.how, HasSubstr("exact, or smoothed"));
}

TEST(RecordedJitter, IsUnknownOfAFewSamples) {
  const RecordedJitter found = recorded_jitter(of_samples(10, 3e-4));
  EXPECT_FALSE(found.known);
  EXPECT_TRUE(found.too_short);
}

}  // namespace
}  // namespace hyperex::session
