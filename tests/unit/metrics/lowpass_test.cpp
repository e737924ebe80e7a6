// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/lowpass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "hyperex/metrics/speed_floor.hpp"

namespace hyperex::metrics {
namespace {

constexpr double cutoff_hz = 6;

Points sines(const std::vector<double>& time_s, double hz) {
  Points track(Eigen::Index(time_s.size()), 3);
  for (Eigen::Index k = 0; k < track.rows(); ++k) {
    const double phase = 2 * M_PI * hz * time_s[std::size_t(k)];
    track.row(k) << std::sin(phase), 2 * std::cos(phase), 1;
  }
  return track;
}

std::vector<double> times(int count, double rate_hz) {
  std::vector<double> t;
  for (int k = 0; k < count; ++k) t.push_back(k / rate_hz);
  return t;
}

TEST(Lowpass, HasTheResponseOfAButterworthFilterRunBothWays) {
  const auto t = times(2001, 200);  // 10 s
  for (const double hz : {1.0, 3.0, 6.0, 9.0, 12.0}) {
    const double expected = 1 / (1 + std::pow(hz / cutoff_hz, 4));
    const SmoothTrack smooth = lowpassed(t, sines(t, hz), cutoff_hz);
    for (Eigen::Index k = 800; k < 1200; k += 7) {  // far from the ends
      const double phase = 2 * M_PI * hz * t[std::size_t(k)];
      EXPECT_NEAR(smooth.value(k, 0), expected * std::sin(phase), 0.01) << hz;  // no phase
      EXPECT_NEAR(smooth.rate(k, 0), expected * 2 * M_PI * hz * std::cos(phase),
                  0.02 * 2 * M_PI * hz)
          << hz;
      EXPECT_NEAR(smooth.value(k, 2), 1, 1e-9);
    }
  }
}

TEST(Lowpass, TakesUnevenTimesAndGaps) {
  std::vector<double> t;
  std::mt19937 engine(2);
  std::uniform_real_distribution<double> step(0.5, 1.5);
  for (double now = 0; t.size() < 300; now += step(engine) / 60) t.push_back(now);
  Points track = sines(t, 1.5);
  for (Eigen::Index k = 140; k < 146; ++k) track.row(k).setConstant(NAN);
  const SmoothTrack smooth = lowpassed(t, track, cutoff_hz);
  for (Eigen::Index k = 30; k < 270; ++k) {
    if (k >= 140 && k < 146) {
      EXPECT_TRUE(std::isnan(smooth.value(k, 0)) && std::isnan(smooth.rate(k, 0)));
      continue;
    }
    const double phase = 2 * M_PI * 1.5 * t[std::size_t(k)];
    EXPECT_NEAR(smooth.value(k, 0), std::sin(phase), 0.02) << k;
    EXPECT_NEAR(smooth.rate(k, 0), 2 * M_PI * 1.5 * std::cos(phase), 0.4) << k;
  }
}

TEST(Lowpass, AStraightLineStaysOne) {
  const auto t = times(20, 30);
  Points line(20, 3);
  for (Eigen::Index k = 0; k < 20; ++k) line.row(k) << t[std::size_t(k)], -2 * t[std::size_t(k)], 5;
  const SmoothTrack smooth = lowpassed(t, line, cutoff_hz);
  EXPECT_LT((smooth.value - line).norm(), 1e-9);
  EXPECT_NEAR(smooth.rate(0, 1), -2, 1e-9);
  EXPECT_NEAR(smooth.rate(19, 0), 1, 1e-9);
  EXPECT_EQ(lowpassed(t, line, 0).value, line);
}

// White noise sampled every dt, filtered by 1 / (1 + (f / fc)^4). The variance of its time
// derivative is
//   2 s^2 dt (2 pi)^2 fc^3 int x^2 / (1 + x^4)^2 dx = 2 s^2 dt (2 pi)^2 fc^3 pi sqrt(2) / 16.
TEST(Lowpass, TheFloorOfSpeedIsThatOfWhiteNoise) {
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

}  // namespace
}  // namespace hyperex::metrics
