// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/lowpass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace hyperex::motion {
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

/// What the spline minimises, at values f with the second derivatives g at the inner samples of a
/// natural spline through them.
double cost(const std::vector<double>& t, const Eigen::VectorXd& y, const Eigen::VectorXd& f) {
  const auto n = Eigen::Index(t.size());
  const auto h = [&](Eigen::Index i) { return t[std::size_t(i + 1)] - t[std::size_t(i)]; };
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(n - 2, n - 2);
  Eigen::VectorXd bent(n - 2);
  for (Eigen::Index j = 0; j < n - 2; ++j) {
    r(j, j) = (h(j) + h(j + 1)) / 3;
    if (j + 1 < n - 2) r(j, j + 1) = r(j + 1, j) = h(j + 1) / 6;
    bent(j) = (f(j + 2) - f(j + 1)) / h(j + 1) - (f(j + 1) - f(j)) / h(j);
  }
  const Eigen::VectorXd g = r.llt().solve(bent);
  double sum = std::pow(2 * M_PI * cutoff_hz, -4) * g.dot(r * g);
  for (Eigen::Index i = 0; i < n; ++i) {
    const double weight = i == 0 ? h(0) : i == n - 1 ? h(n - 2) : (h(i - 1) + h(i)) / 2;
    sum += weight * std::pow(y(i) - f(i), 2);
  }
  return sum;
}

TEST(Lowpass, MinimisesTheCostOfASmoothingSpline) {
  std::vector<double> t = {0, 0.02, 0.07, 0.08, 0.12, 0.2, 0.21, 0.27, 0.3};
  std::mt19937 engine(4);
  std::normal_distribution<double> normal(0, 1);
  Points track(Eigen::Index(t.size()), 3);
  for (double& value : track.reshaped()) value = normal(engine);
  const SmoothTrack smooth = lowpassed(t, track, cutoff_hz);
  const Eigen::VectorXd y = track.col(1), f = smooth.value.col(1);
  const double least = cost(t, y, f);
  for (Eigen::Index i = 0; i < f.size(); ++i)
    for (const double step : {-1e-3, 1e-3}) {
      Eigen::VectorXd other = f;
      other(i) += step;
      EXPECT_GT(cost(t, y, other), least) << i;
    }
}

TEST(Lowpass, OneFilterServesTracksWithAndWithoutGaps) {
  const auto t = times(90, 30);
  Points track = sines(t, 2), gaps = track;
  gaps.middleRows(40, 5).setConstant(NAN);
  const LowpassFilter filter(t, cutoff_hz);
  EXPECT_EQ(filter(track).value, lowpassed(t, track, cutoff_hz).value);
  const SmoothTrack bridged = filter(gaps);
  EXPECT_TRUE(std::isnan(bridged.value(42, 0)));
  EXPECT_NEAR(bridged.value(39, 0), filter(track).value(39, 0), 0.02);
}

}  // namespace
}  // namespace hyperex::motion
