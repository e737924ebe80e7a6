// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/excursion.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hyperex/metrics/speed_floor.hpp"

namespace hyperex::metrics {
namespace {

constexpr int samples = 61;
constexpr double end_s = 2, left_m = 0.006;

/// Once there and back: 0 to 1 to 0.
double swing(double t) {
  return 0.5 * (1 - std::cos(2 * M_PI * t / end_s));
}

/// Mouth corners of which the left one moves 6 mm, and the right one `share` of that, mirrored; the
/// lip is at rest.
motion::Motion smile(double share) {
  motion::Motion motion;
  motion.names = {"cheilion_L", "cheilion_R", "labiale_inferius"};
  const Vec3 way = left_m * Vec3(2, 3, -6) / 7;
  for (int k = 0; k < samples; ++k) {
    const double t = end_s * k / (samples - 1);
    Points at(3, 3);
    at << 0.025, 0.01, 0.002, -0.025, 0.01, 0.002, 0, 0, 0.01;
    at.row(0) += swing(t) * way.transpose();
    at.row(1) += share * swing(t) * Eigen::RowVector3d(-way.x(), way.y(), way.z());
    motion.time_s.push_back(t);
    motion.positions.push_back(at);
  }
  return motion;
}

TEST(Excursion, OfAMirroredMotionHasRatioOne) {
  const Excursions all = excursions_of(smile(1));
  ASSERT_EQ(all.pairs.size(), 1u);
  const PairExcursion& p = all.pairs[0];
  EXPECT_EQ(p.name, "cheilion");
  EXPECT_DOUBLE_EQ(p.excursion_ratio, 1);
  EXPECT_DOUBLE_EQ(p.path_ratio, 1);
  EXPECT_DOUBLE_EQ(p.speed_ratio, 1);
  EXPECT_NEAR(p.speed_correlation, 1, 1e-12);
  EXPECT_FALSE(p.undecided);
}

TEST(Excursion, OfAOneSidedSmileIsKnown) {
  const motion::Motion motion = smile(0.25);
  const PairExcursion p = excursions_of(motion).pairs[0];
  EXPECT_NEAR(p.left_side.excursion_mm, 6, 1e-9);
  EXPECT_NEAR(p.right_side.excursion_mm, 1.5, 1e-9);
  EXPECT_NEAR(p.excursion_ratio, 0.25, 1e-9);
  EXPECT_NEAR(p.left_side.path_mm, 12, 1e-9);
  EXPECT_NEAR(p.path_ratio, 0.25, 1e-9);
  // The central difference of a sine is lower by sin(w h) / (w h).
  const double w = 2 * M_PI / end_s, wh = w * end_s / (samples - 1);
  EXPECT_NEAR(p.left_side.peak_speed_mm_s, 6 * w / 2 * std::sin(wh) / wh, 1e-6);
  EXPECT_NEAR(p.speed_ratio, 0.25, 1e-9);
  EXPECT_NEAR(p.speed_correlation, 1, 1e-9);
  const Commissure mouth = excursions_of(motion).commissure;
  EXPECT_NEAR(mouth.left_mm[samples / 2], 6, 1e-9);
  EXPECT_NEAR(mouth.right_mm[samples / 2], 1.5, 1e-9);
  const auto from_lip = [&](int k) {
    return 1e3 * (motion.positions[k].row(0) - motion.positions[k].row(2)).norm();
  };
  EXPECT_NEAR(mouth.left_from_midlip_mm, from_lip(samples / 2) - from_lip(0), 1e-9);
  EXPECT_GT(mouth.left_from_midlip_mm, 3 * mouth.right_from_midlip_mm);
}

TEST(Excursion, OfAParalysedSideHasRatioZeroAndNoCorrelation) {
  const PairExcursion p = excursions_of(smile(0)).pairs[0];
  EXPECT_NEAR(p.excursion_ratio, 0, 1e-12);
  EXPECT_TRUE(std::isnan(p.speed_correlation));
}

TEST(Excursion, ALateSideIsSeenInTheCorrelationOfSpeeds) {
  motion::Motion motion = smile(1);
  const motion::Motion straight = motion;
  for (int k = 0; k < samples; ++k)
    motion.positions[k].row(1) = straight.positions[std::max(0, k - 8)].row(1);
  const PairExcursion p = excursions_of(motion).pairs[0];
  EXPECT_NEAR(p.excursion_ratio, 1, 1e-9);
  EXPECT_LT(p.speed_correlation, 0.5);
}

// The expected bound is 1.96 standard deviations of the difference of two excursions, each of which
// is the difference of two positions.
TEST(Excursion, JitterLeavesSmallDifferencesUndecided) {
  const motion::Motion motion = smile(0.9);  // differ by 0.6 mm
  EXPECT_FALSE(excursions_of(motion, 0.99 * 0.6e-3 / 3.92, 0).pairs[0].undecided);
  EXPECT_TRUE(excursions_of(motion, 1.01 * 0.6e-3 / 3.92, 0).pairs[0].undecided);
}

/// Eight tenths of a second at rest, then there and back; the peak speed of the left corner is
/// `left_mm_s`.
motion::Motion noisy_smile(double left_mm_s, double right_mm_s, double jitter_m, unsigned seed) {
  motion::Motion motion;
  motion.names = {"cheilion_L", "cheilion_R"};
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, jitter_m);
  const Vec3 way = Vec3(2, 3, -6) / 7;
  for (int k = 0; k < 85; ++k) {
    const double t = k / 30.0, course = t < 0.8 ? 0 : swing(t - 0.8) / (M_PI / end_s);
    Points at(2, 3);
    at << 0.025, 0.01, 0.002, -0.025, 0.01, 0.002;
    at.row(0) += 1e-3 * left_mm_s * course * way.transpose();
    at.row(1) += 1e-3 * right_mm_s * course * Eigen::RowVector3d(-way.x(), way.y(), way.z());
    for (Eigen::Index p = 0; p < 2; ++p)
      for (Eigen::Index axis = 0; axis < 3; ++axis) at(p, axis) += normal(engine);
    motion.time_s.push_back(t);
    motion.positions.push_back(at);
  }
  return motion;
}

TEST(Excursion, FilteringLowersTheFloorOfJitterToWhatIsLeftOfIt) {
  constexpr double jitter_m = 0.3e-3;
  constexpr int draws = 300;
  int beyond = 0, beyond_half = 0;
  for (unsigned seed = 1; seed <= draws; ++seed) {
    const PairExcursion p = excursions_of(noisy_smile(15, 15, jitter_m, seed), jitter_m).pairs[0];
    EXPECT_LT(p.jitter_floor_mm, 0.8 * 3.92 * 1e3 * jitter_m);
    beyond += p.undecided ? 0 : 1;
    beyond_half += std::abs(p.difference_mm()) > 0.5 * p.jitter_floor_mm;
  }
  EXPECT_LE(beyond, 0.08 * draws);
  EXPECT_GE(beyond_half, 0.2 * draws) << "the floor is not wider than it need be";
}

TEST(Excursion, JitterThatAFilterLeavesIsNotCountedAsFiltered) {
  motion::Motion motion = noisy_smile(0, 0, 0.3e-3, 3);
  for (size_t k = 1; k < motion.positions.size(); ++k)
    motion.positions[k] = 0.8 * motion.positions[k - 1] + 0.2 * motion.positions[k];
  constexpr double jitter_m = 0.02e-3;
  const PairExcursion p = excursions_of(motion, jitter_m).pairs[0];
  EXPECT_GT(p.jitter_widening, 1.5);
  EXPECT_NEAR(p.jitter_floor_mm, 3.92 * 1e3 * jitter_m, 1e-4);
}

TEST(Excursion, SpeedsOfANoisyRecordingAreThoseOfTheMotionWithinTheirFloor) {
  constexpr double jitter_m = 0.15e-3, left_mm_s = 15.7, right_mm_s = 2.8;
  int beyond = 0, correlations = 0, undecided = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    const motion::Motion motion = noisy_smile(left_mm_s, right_mm_s, jitter_m, seed);
    const Excursions all = excursions_of(motion, jitter_m);
    const PairExcursion& p = all.pairs[0];
    EXPECT_EQ(all.lowpass_hz, kUsualLowpass_hz);
    EXPECT_LT(p.peak_speed_floor_mm_s, 9);
    beyond += std::abs(p.left_side.peak_speed_mm_s - left_mm_s) > p.peak_speed_floor_mm_s;
    beyond += std::abs(p.right_side.peak_speed_mm_s - right_mm_s) > p.peak_speed_floor_mm_s;
    undecided += p.peak_speed_undecided;  // 15.7 is more than 2.8
    // The truth is 1: nothing far from it is called decided.
    EXPECT_TRUE(p.speed_correlation_undecided || p.speed_correlation >= 0.8);
    correlations += p.speed_correlation_undecided;
    // Without the filter the slow side's speed is noise.
    EXPECT_GT(excursions_of(motion, jitter_m, 0).pairs[0].right_side.peak_speed_mm_s, 6);
  }
  EXPECT_LE(beyond, 2);  // of 40: floors for 95 %
  EXPECT_EQ(correlations, 20);
  EXPECT_LE(undecided, 2);
}

TEST(Excursion, AlikeSpeedsWithLittleNoiseCorrelateAndAreUndecidedInSize) {
  const PairExcursion p = excursions_of(noisy_smile(30, 30, 0.1e-3, 5), 0.1e-3).pairs[0];
  EXPECT_GT(p.speed_correlation, 0.9);
  EXPECT_FALSE(p.speed_correlation_undecided);
  EXPECT_TRUE(p.peak_speed_undecided);
  EXPECT_TRUE(p.path_undecided);
  EXPECT_NEAR(p.path_ratio, 1, 0.15);
}

TEST(Excursion, JitterAloneIsUndecidedThroughout) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const PairExcursion p = excursions_of(noisy_smile(0, 0, 0.3e-3, seed), 0.3e-3).pairs[0];
    EXPECT_TRUE(p.undecided && p.path_undecided && p.peak_speed_undecided &&
                p.speed_correlation_undecided);
    EXPECT_TRUE(std::isnan(p.speed_ratio));  // noise over noise
  }
}

TEST(Excursion, JitterThatLastsWidensTheFloors) {
  // Noise of 0.3 mm that a tracker has smoothed itself: a fifth of it left from sample to sample.
  motion::Motion motion = noisy_smile(0, 0, 0.3e-3, 3);
  for (size_t k = 1; k < motion.positions.size(); ++k)
    motion.positions[k] = 0.8 * motion.positions[k - 1] + 0.2 * motion.positions[k];
  constexpr double jitter_m = 0.02e-3;  // as if the little that differs between samples were all
  const PairExcursion p = excursions_of(motion, jitter_m).pairs[0];
  EXPECT_GT(p.peak_speed_floor_mm_s, 1.5 * speed_floor(motion.time_s, jitter_m, 6).peak_mm_s);
}

TEST(Excursion, KnowsIbugPairsAndLeavesOutWhatStartsUnmeasured) {
  motion::Motion motion = smile(0.5);
  for (const char* form : {"ibug68_", "p", ""}) {
    motion.names = {std::string(form) + "54", std::string(form) + "48", "ibug68_57"};
    const Excursions all = excursions_of(motion);
    ASSERT_EQ(all.pairs.size(), 1u) << form;
    EXPECT_EQ(all.pairs[0].name, "ibug68_48/54");
    EXPECT_NEAR(all.pairs[0].excursion_ratio, 0.5, 1e-9);
    EXPECT_EQ(all.commissure.left, 0);
  }
  motion.positions[5].row(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  const Excursions gap = excursions_of(motion);
  EXPECT_NEAR(gap.pairs[0].left_side.excursion_mm, 6, 1e-9);
  EXPECT_TRUE(std::isnan(gap.commissure.left_mm[5]));
  EXPECT_TRUE(std::isnan(gap.commissure.left_mm_s[5]));
  motion.positions[0].row(0).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_TRUE(excursions_of(motion).pairs.empty());
}

}  // namespace
}  // namespace hyperex::metrics
