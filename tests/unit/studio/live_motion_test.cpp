// SPDX-License-Identifier: GPL-3.0-or-later
#include "live_motion.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/stabilise.hpp"

namespace hyperex::studio {
namespace {

constexpr int kRest = 8;

/// The embedded mouth opening at 30 Hz after some frames at rest, recorded with jitter while the
/// head rotates.
motion::Motion seen_opening(const io::Landmarks& landmarks) {
  const motion::Motion opening = motion::embedded_mouth_opening(landmarks);
  std::mt19937 random(3);
  std::normal_distribution<double> jitter(0, 5e-5);
  motion::Motion seen;
  seen.names = opening.names;
  for (int k = 0; k < 50; ++k) {
    seen.time_s.push_back(k / 30.0);
    const double turn = k < kRest ? 0 : 0.01 * (k - kRest);
    const Eigen::Matrix3d rotation(Eigen::AngleAxisd(turn, Vec3(0.3, 1, 0).normalized()));
    Points at = opening.at(opening.time_s.front() + std::max(0, k - kRest) / 30.0);
    for (double& x : at.reshaped()) x += jitter(random);
    at = (0.9 * at * rotation.transpose()).eval();
    at.rowwise() += Eigen::RowVector3d(0.01 * turn, 0.02, 0.6);
    seen.positions.push_back(std::move(at));
  }
  return seen;
}

std::vector<LiveSample> samples_of(const motion::Motion& m) {
  std::vector<LiveSample> samples;
  for (std::size_t k = 0; k < m.time_s.size(); ++k)
    samples.push_back({m.time_s[k], m.positions[k]});
  return samples;
}

double farthest(const Points& a, const Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

TEST(LiveMotion, BringsSamplesToTheScanAsARunBringsTheRecording) {
  const io::Landmarks landmarks = anatomy::embedded_face().landmarks;
  const motion::Motion seen = seen_opening(landmarks);
  const std::vector<LiveSample> samples = samples_of(seen);
  LiveMotion live(seen.names, {samples.begin(), samples.begin() + kRest}, landmarks,
                  simulate::AlignmentMethod::nonrigid);

  motion::Motion whole = seen;
  whole.positions.front() = live.neutral();
  const simulate::AlignedMotion run = simulate::align(motion::stabilise(whole).motion, landmarks);
  EXPECT_LT(farthest(live.at_rest(0.03).rest, run.rest), 1e-9);
  double most_m = 0, off_m = 0;
  for (std::size_t k = 1; k < samples.size(); ++k) {
    const Points now = live.displacement(samples[k]);
    const Points truth = run.motion.positions[k] - run.rest;
    most_m = std::max(most_m, truth.rowwise().norm().maxCoeff());
    off_m = std::max(off_m, farthest(now, truth));
  }
  EXPECT_GT(most_m, 0.01) << "the mouth opens";
  // The pose is smoothed over what came before alone.
  EXPECT_LT(off_m, 3e-4);
}

TEST(LiveMotion, RefusesPointsThatTheScanDoesNotKnow) {
  const std::deque<LiveSample> samples(6, {0, Points::Random(4, 3)});
  EXPECT_THROW(LiveMotion({"a", "b", "c", "d"}, samples, anatomy::embedded_face().landmarks,
                          simulate::AlignmentMethod::nonrigid),
               InputError);
}

TEST(LiveTake, BeginsAtTheNeutralFaceAndIsLedFromItIntoAnExpression) {
  const io::Landmarks landmarks = anatomy::embedded_face().landmarks;
  const motion::Motion seen = seen_opening(landmarks);
  const std::vector<LiveSample> samples = samples_of(seen);
  const Points neutral = samples.front().positions;
  const motion::Motion whole = motion_of_take(seen.names, samples, neutral, 0, 10);
  EXPECT_EQ(whole.time_s.size(), samples.size());
  EXPECT_EQ(whole.time_s.front(), 0);
  EXPECT_EQ(whole.positions.front(), neutral);
  EXPECT_NEAR(whole.time_s.back(), samples.back().time_s, 1e-9);

  const motion::Motion part = motion_of_take(seen.names, samples, neutral, 1.0, 1.2);
  EXPECT_EQ(part.positions.front(), neutral);
  EXPECT_EQ(part.time_s.front(), 0);
  EXPECT_NEAR(part.time_s.back(), 0.5 + 0.2, 1e-9) << "half a second leads into it";
  const std::size_t first = part.positions.size() - 7;
  EXPECT_NEAR(part.time_s[first], 0.5, 1e-9);
  // Head pose is out of both, found over the whole and over the part.
  EXPECT_LT(farthest(part.positions[first], whole.positions[30]), 5e-4);
  EXPECT_THROW(motion_of_take(seen.names, samples, neutral, 1.0, 1.01), InputError);
}

}  // namespace
}  // namespace hyperex::studio
