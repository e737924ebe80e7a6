// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/stillness.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "support/note_matchers.hpp"

namespace hyperex::session {
namespace {
using test::is_about;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Optional;

struct NoisyPoints {
  double noise_m = 2e-4;
  double smile_m = 0;  ///< one point goes up and back within 3 s
  double blink_m = 0;  ///< two points go down and back within 0.2 s
  double step_s = 1 / 30.0;
  int count = 91;
  double noisier = 1;  ///< the last point, than the others
};

/// Twelve points and their white noise.
motion::Motion noisy_points(const NoisyPoints& is) {
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  motion::Motion m;
  for (int p = 0; p < 12; ++p) m.names.push_back("point_" + std::to_string(p));
  for (int k = 0; k < is.count; ++k) {
    const double t = k * is.step_s;
    m.time_s.push_back(t);
    Points at(12, 3);
    for (Eigen::Index p = 0; p < 12; ++p)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        at(p, axis) = 0.01 * double(p) + (p == 11 ? is.noisier : 1) * is.noise_m * normal(random);
    const double lasts_s = double(is.count - 1) * is.step_s;
    at(3, 1) += is.smile_m * std::pow(std::sin(std::numbers::pi * t / lasts_s), 2);
    const double from_blink_s = (t - lasts_s / 2) / 0.1;
    for (const Eigen::Index lid : {7, 8})
      at(lid, 1) -= is.blink_m * std::max(0.0, 1 - std::abs(from_blink_s));
    m.positions.push_back(at);
  }
  return m;
}

bool is_still(const NoisyPoints& points) {
  return stillness_warning(noisy_points(points), false).has_value();
}

TEST(StillnessWarning, HoldsAgainstTheRecordingsOwnJitter) {
  EXPECT_THAT(stillness_warning(noisy_points({}), false),
              Optional(AllOf(is_warning("recording.nothing_moves"), is_about("motion.unit"),
                             says("beyond its jitter of 0.2"), says("smoothed, no point goes"),
                             says("that the expression was made"))));
  for (const double noise_m : {0.5e-4, 1e-4, 4e-4}) EXPECT_TRUE(is_still({.noise_m = noise_m}));
  EXPECT_TRUE(is_still({.count = 31}));
  EXPECT_TRUE(is_still({.noisier = 2})) << "the jitter of a point is its own";
}

TEST(StillnessWarning, LeavesSmallMovementsAlone) {
  EXPECT_FALSE(is_still({.smile_m = 1.5e-3}));
  EXPECT_FALSE(is_still({.noise_m = 0.5e-4, .smile_m = 0.5e-3}));
  EXPECT_FALSE(is_still({.blink_m = 8e-3}));
  EXPECT_FALSE(is_still({.noise_m = 0, .smile_m = 1e-4})) << "without jitter 0.05 mm count";
  EXPECT_TRUE(is_still({.noise_m = 0, .smile_m = 3e-5}));
  EXPECT_FALSE(is_still({.noise_m = 1e-3, .smile_m = 4e-3})) << "3 mm count in any jitter";
}

TEST(StillnessWarning, IsSilentWhereJitterIsNotToldFromMotion) {
  EXPECT_FALSE(is_still({.count = 16}));
  EXPECT_FALSE(is_still({.step_s = 0.2}));
  EXPECT_EQ(stillness_warning(noisy_points({}), true), std::nullopt) << "the eyes turn";
}

}  // namespace
}  // namespace hyperex::session
