// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/speed_floor.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "hyperex/motion/lowpass.hpp"

namespace hyperex::metrics {
namespace {

constexpr double cutoff_hz = 6;

std::vector<double> times(int count, double rate_hz) {
  std::vector<double> t;
  for (int k = 0; k < count; ++k) t.push_back(k / rate_hz);
  return t;
}

// White noise sampled every dt, filtered by 1 / (1 + (f / fc)^4). The variance of its time
// derivative is
//   2 s^2 dt (2 pi)^2 fc^3 int x^2 / (1 + x^4)^2 dx = 2 s^2 dt (2 pi)^2 fc^3 pi sqrt(2) / 16.
TEST(SpeedFloor, IsThatOfWhiteNoise) {
  const auto t = times(1200, 120);
  const double jitter_m = 0.2e-3;
  const double variance = 2 * std::pow(1e3 * jitter_m, 2) / 120 * std::pow(2 * M_PI, 2) *
                          std::pow(cutoff_hz, 3) * M_PI * std::sqrt(2.0) / 16;
  const SpeedFloor floor = speed_floor(t, jitter_m, cutoff_hz);
  EXPECT_NEAR(floor.rms_mm_s, std::sqrt(3 * variance), 0.05 * std::sqrt(3 * variance));
  EXPECT_GT(floor.peak_mm_s, 1.5 * floor.rms_mm_s);
  EXPECT_LT(floor.peak_mm_s, 4 * floor.rms_mm_s);
  EXPECT_EQ(floor.peak_mm_s, speed_floor(t, jitter_m, cutoff_hz).peak_mm_s);
  EXPECT_EQ(speed_floor(t, 0, cutoff_hz).peak_mm_s, 0);
}

/// A long recording has its floor from fewer tracks of noise.
TEST(SpeedFloor, OfALongRecordingHoldsToo) {
  const auto t = times(24000, 120);
  const double jitter_m = 0.2e-3;
  const SpeedFloor floor = speed_floor(t, jitter_m, cutoff_hz);
  std::mt19937 engine(9);
  std::normal_distribution<double> normal(0, 1e3 * jitter_m);
  const motion::LowpassFilter filter(t, cutoff_hz);
  Points noise(Eigen::Index(t.size()), 3);
  int below = 0, shorter = 0;
  for (int draw = 0; draw < 40; ++draw) {
    for (double& value : noise.reshaped()) value = normal(engine);
    const motion::SmoothTrack smooth = filter(noise);
    const Eigen::VectorXd speed = smooth.rate.rowwise().norm();
    below += motion::greatest_inside(t, {speed.begin(), speed.end()}, cutoff_hz) < floor.peak_mm_s;
    const Eigen::Index steps = noise.rows() - 1;
    shorter +=
        (smooth.value.bottomRows(steps) - smooth.value.topRows(steps)).rowwise().norm().sum() <
        floor.path_mm;
  }
  EXPECT_GE(below, 32);
  EXPECT_GE(shorter, 32);
  EXPECT_LT(floor.path_mm / floor.rms_mm_s, 1.01 * t.back());
}

}  // namespace
}  // namespace hyperex::metrics
