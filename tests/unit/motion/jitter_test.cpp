// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/jitter.hpp"

#include <random>

#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

const std::vector<std::string> kNames = {"a", "b", "c", "d", "e", "f"};
const std::vector<int> kAll = {0, 1, 2, 3, 4, 5};

/// A smile of 10 mm that appears and disappears all the time, so that the face never rests. It
/// follows a minimum-jerk course of half a second (peak speed 37 mm/s).
double smile_m(double t, int point) {
  const double u = std::abs(std::remainder(t + 0.05 * point, 1.0)) / 0.5;
  return 0.010 * u * u * u * (10 + u * (-15 + 6 * u));
}

Motion smiles(double step_s = 1.0 / 30, int samples = 120) {
  return testing::sampled(samples, step_s, kNames, [](double t, int point, int axis) {
    return 0.02 * point + (axis == 2 ? 0.3 : 1) * smile_m(t, point);
  });
}

/// Noise as of a depth camera: the depth is noisier than the directions in the picture.
void add_noise(Motion& motion, double jitter_m, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> noise(0, jitter_m);
  const double axis_share[3] = {0.8, 0.8, std::sqrt(3 - 2 * 0.64)};
  for (Points& sample : motion.positions)
    for (Eigen::Index p = 0; p < sample.rows(); ++p)
      for (int axis = 0; axis < 3; ++axis) sample(p, axis) += axis_share[axis] * noise(generator);
}

TEST(JitterOfMotion, IsFoundWhereTheFaceNeverRests) {
  for (const double jitter_m : {0.05e-3, 0.2e-3, 0.5e-3})
    for (const unsigned seed : {1U, 2U, 3U}) {
      Motion motion = smiles();
      add_noise(motion, jitter_m, seed);
      EXPECT_NEAR(jitter_of_motion(motion, kAll) / jitter_m, 1, 0.15) << jitter_m << ' ' << seed;
    }
}

TEST(JitterOfMotion, AFastCleanMotionHasNone) {
  EXPECT_LT(jitter_of_motion(smiles(), kAll), 0.01e-3);
  EXPECT_LT(jitter_of_motion(smiles(1.0 / 60), kAll), 0.001e-3);
  const Motion shaken = testing::sampled(120, 1.0 / 30, kNames, [](double t, int point, int axis) {
    return axis == 1 ? 0.005 * std::sin(2 * M_PI * 3 * t + point) : 0.0;
  });
  // 0.051 mm along its axis; neighbouring samples alone would make it 0.09.
  EXPECT_LT(std::sqrt(3.0) * jitter_of_motion(shaken, kAll), 0.06e-3);
}

TEST(JitterOfMotion, UnevenTimesAndGapsDoNotMatter) {
  Motion motion = smiles();
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> late(-0.01, 0.01);
  for (std::size_t k = 0; k < motion.time_s.size(); ++k) {
    motion.time_s[k] += late(generator);
    for (Eigen::Index p = 0; p < 6; ++p)
      for (int axis = 0; axis < 3; ++axis)
        motion.positions[k](p, axis) =
            0.02 * double(p) + (axis == 2 ? 0.3 : 1) * smile_m(motion.time_s[k], int(p));
  }
  EXPECT_LT(jitter_of_motion(motion, kAll), 0.03e-3);
  add_noise(motion, 0.3e-3, 6);
  for (std::size_t k = 30; k < 40; ++k) motion.positions[k].row(2).setConstant(testing::nan);
  EXPECT_NEAR(jitter_of_motion(motion, kAll) / 0.3e-3, 1, 0.15);
}

TEST(JitterOfMotion, OfSmoothedNoiseItSeesAPart) {
  // A moving mean of five samples leaves 1 / sqrt(5) of white noise, but hardly any fast noise.
  Motion noise = testing::sampled(400, 1.0 / 30, kNames, [](double, int, int) { return 0.0; });
  add_noise(noise, 0.5e-3, 7);
  Motion smoothed = noise;
  smoothed.positions.clear();
  smoothed.time_s.resize(396);
  for (std::size_t k = 0; k + 5 <= noise.positions.size(); ++k) {
    Points sum = noise.positions[k];
    for (std::size_t i = 1; i < 5; ++i) sum += noise.positions[k + i];
    smoothed.positions.push_back(sum / 5);
  }
  const double left_m = 0.5e-3 / std::sqrt(5.0);
  EXPECT_LT(jitter_of_motion(smoothed, kAll), 0.7 * left_m);
  EXPECT_GT(jitter_of_motion(noise, kAll), 0.85 * 0.5e-3);
}

TEST(JitterOfMotion, ABriefOrUnmeasuredMotionDoesNotTell) {
  EXPECT_TRUE(std::isnan(jitter_of_motion(smiles(1.0 / 30, 19), kAll)));
  Motion lost = smiles();
  for (Points& sample : lost.positions) sample.row(1).setConstant(testing::nan);
  EXPECT_TRUE(std::isnan(jitter_of_motion(lost, {1})));
  EXPECT_TRUE(std::isnan(jitter_of_motion(smiles(), {})));
}

TEST(JitterOfMotion, KnownNoiseOnRealExpressionsIsFound) {
  for (const std::string name : {"subject_A_mouth_open", "subject_A_talk"}) {
    const auto folder = testing::recording(name);
    if (folder.empty()) GTEST_SKIP() << "the shared recordings are not here";
    const Motion truth = read_motion(folder / "truth_landmarks68_camera_m.csv");
    const std::vector<int> mouth_and_eyes = {48, 54, 36, 45, 40, 41, 46, 47, 31, 35, 50, 52};
    EXPECT_LT(jitter_of_motion(stabilise(truth).motion, mouth_and_eyes), 0.02e-3) << name;
    Motion noisy = truth;
    add_noise(noisy, 0.15e-3, 9);
    EXPECT_NEAR(jitter_of_motion(stabilise(noisy).motion, mouth_and_eyes) / 0.15e-3, 1, 0.15)
        << name;
  }
}

}  // namespace
}  // namespace hyperex::motion
