// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/pose_keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyperex::report {
namespace {
using ::testing::ElementsAre;

constexpr int kVertices = 60;

PointsF shape(int seed) {
  PointsF made(kVertices, 3);
  for (Eigen::Index i = 0; i < made.size(); ++i)
    made.data()[i] = 0.01F * float(std::sin(0.37 * double(i) * (seed + 1) + seed));
  return made;
}

/// A smile, then an open mouth, then both at once; back to rest in between.
std::vector<PointsF> expressions() {
  std::vector<PointsF> frames;
  for (int f = 0; f <= 60; ++f) {
    const double phase = f % 20 * M_PI / 20;
    const double most = std::sin(phase);
    frames.push_back(float(f < 20 || f >= 40 ? most : 0) * shape(1) +
                     float(f >= 20 ? most : 0) * shape(2));
  }
  return frames;
}

double error_of(const std::vector<PointsF>& frames, const PoseKeys& keys) {
  double worst = 0;
  for (std::size_t f = 0; f < frames.size(); ++f) {
    PointsF shown = PointsF::Zero(kVertices, 3);
    for (std::size_t k = 0; k < keys.frames.size(); ++k)
      shown += keys.weights(Eigen::Index(f), Eigen::Index(k)) * frames[std::size_t(keys.frames[k])];
    worst = std::max(worst, double((shown - frames[f]).rowwise().norm().maxCoeff()));
  }
  return worst;
}

PoseKeys keys_of(const std::vector<PointsF>& frames, double tolerance_m, std::size_t most = 100) {
  std::size_t count = 0;
  return pose_keys(frames, tolerance_m, [&](int) { return count++ < most; });
}

TEST(PoseKeys, AreThePeaksOfExpressionsAndMixThem) {
  const auto frames = expressions();
  const PoseKeys keys = keys_of(frames, 1e-5);
  // The peaks; the two at once are a sum of them only where weights may add up.
  EXPECT_LE(keys.frames.size(), 3u);
  EXPECT_THAT(keys.frames, ::testing::Contains(50));
  EXPECT_GE(keys.weights.minCoeff(), 0);
  EXPECT_LE(keys.weights.maxCoeff(), 1);
  for (std::size_t k = 0; k < keys.frames.size(); ++k)
    EXPECT_EQ(keys.weights(keys.frames[k], Eigen::Index(k)), 1);
  EXPECT_LE(error_of(frames, keys), 1e-5 + 1e-7);
  EXPECT_NEAR(error_of(frames, keys), keys.max_error_m, 1e-7);
}

TEST(PoseKeys, AreFewerWithALargerToleranceAndKeepToIt) {
  std::vector<PointsF> frames = expressions();
  for (std::size_t f = 0; f < frames.size(); ++f) frames[f] += 0.02F * shape(int(f) + 5);  // jitter
  std::size_t before = 1000;
  for (const double tolerance_m : {1e-4, 6e-4, 2e-3}) {
    const PoseKeys keys = keys_of(frames, tolerance_m);
    EXPECT_LE(keys.max_error_m, tolerance_m);
    EXPECT_NEAR(error_of(frames, keys), keys.max_error_m, 1e-7);
    EXPECT_LT(keys.frames.size(), before) << tolerance_m;
    before = keys.frames.size();
  }
}

TEST(PoseKeys, TellTheErrorThatALimitLeaves) {
  const auto frames = expressions();
  const PoseKeys keys = keys_of(frames, 1e-5, 1);
  ASSERT_EQ(keys.frames.size(), 1u);
  EXPECT_GT(keys.max_error_m, 1e-3);
  EXPECT_NEAR(error_of(frames, keys), keys.max_error_m, 1e-7);
}

TEST(PoseKeys, AreNoneWithoutMotion) {
  const std::vector<PointsF> still(5, PointsF::Zero(kVertices, 3));
  EXPECT_TRUE(keys_of(still, 1e-4).frames.empty());
}

TEST(PoseKeys, AreNamedByTheirTimes) {
  PoseKeys keys;
  keys.frames = {1, 2};
  EXPECT_THAT(pose_names(keys, {10, 10.5, 10.9333333}), ElementsAre("pose_0.500s", "pose_0.933s"));
  EXPECT_THAT(pose_names(keys, {0, 0.0001, 0.0002}), ElementsAre("pose_0.0001s", "pose_0.0002s"));
}

}  // namespace
}  // namespace hyperex::report
