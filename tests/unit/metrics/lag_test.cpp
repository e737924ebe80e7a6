// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/lag.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <stdexcept>

namespace hyperex::metrics {
namespace {

std::vector<double> sample_times(int count, double step) {
  std::vector<double> t;
  for (int k = 0; k < count; ++k) t.push_back(k * step);
  return t;
}

std::vector<double> sampled(const std::vector<double>& t,
                            const std::function<double(double)>& signal) {
  std::vector<double> out;
  for (const double at : t) out.push_back(signal(at));
  return out;
}

// A mouth that opens and closes, 80 samples at 30 Hz.
double opening(double t) {
  return t < 0 || t > 2.6 ? 0 : 0.5 * (1 - std::cos(2 * M_PI * t / 2.6));
}
// A faster motion, as in talking: 15 samples per period, within an envelope.
double talk(double t) {
  return opening(t) * (1 + 0.5 * std::sin(2 * M_PI * 2 * t));
}

TEST(Lag, OfASignalShiftedByAPartOfAStepIsFoundToAThousandthOfIt) {
  const double step = 1 / 30.0;
  const std::vector<double> t = sample_times(90, step);
  double worst = 0;
  for (double (*signal)(double) : {opening, talk})
    for (const double share : {0.37, -0.37, 0.0, 0.03, 1.5}) {
      const double shift = share * step;
      const Lag lag = lag_of(t, sampled(t, signal),
                             sampled(t, [&](double at) { return 3 * signal(at - shift) + 0.1; }));
      worst = std::max(worst, std::abs(lag.lag_s - shift) / step);
      EXPECT_NEAR(lag.lag_s, shift, 1e-3 * step) << share;
      EXPECT_NEAR(lag.correlation, 1, 1e-5);
      EXPECT_FALSE(lag.at_limit);
    }
  std::cout << "lag: " << worst << " steps off at most\n";
}

// Viscosity gives a first-order response, whose lag at low frequency is its time constant.
TEST(Lag, OfAFirstOrderResponseIsItsTimeConstant) {
  const double step = 1 / 30.0, constant_s = 0.007, fine = 1e-5;
  const std::vector<double> t = sample_times(90, step);
  std::vector<double> response;
  double y = 0, at = 0;
  for (const double wanted : t) {
    for (; at < wanted - fine / 2; at += fine) y += fine / constant_s * (opening(at) - y);
    response.push_back(y);
  }
  const Lag lag = lag_of(t, sampled(t, opening), response);
  EXPECT_NEAR(lag.lag_s, constant_s, 2e-4);
}

TEST(Lag, BeyondWhatIsLookedAtIsToldAsSuch) {
  const std::vector<double> t = sample_times(90, 1 / 30.0);
  const Lag lag =
      lag_of(t, sampled(t, opening), sampled(t, [](double at) { return opening(at - 0.3); }));
  EXPECT_TRUE(lag.at_limit);
  EXPECT_NEAR(lag.lag_s, 0.1, 1e-12);
}

TEST(Lag, OfWhatDoesNotMoveIsNoNumber) {
  const std::vector<double> t = sample_times(90, 1 / 30.0), still(90, 2.0);
  EXPECT_TRUE(std::isnan(lag_of(t, still, sampled(t, opening)).lag_s));
  EXPECT_TRUE(std::isnan(lag_of(t, sampled(t, opening), still).lag_s));
  const std::vector<double> brief = sample_times(10, 1 / 30.0);
  EXPECT_TRUE(std::isnan(lag_of(brief, brief, brief).lag_s));
  EXPECT_THROW(lag_of(t, still, brief), std::invalid_argument);
  EXPECT_THROW(lag_of(t, still, still, 0), std::invalid_argument);
}

TEST(Hysteresis, OfAnEllipseIsTheSineOfItsPhase) {
  const std::vector<double> t = sample_times(2000, 2 * M_PI / 2000);
  for (const double phase : {0.0, 0.1, 0.7, M_PI / 2, -0.3}) {
    const double h =
        hysteresis_of(sampled(t, [](double at) { return 5 + 2 * std::sin(at); }),
                      sampled(t, [&](double at) { return 0.3 * std::sin(at - phase) - 1; }));
    EXPECT_NEAR(h, M_PI / 4 * std::abs(std::sin(phase)), 1e-5) << phase;
  }
}

TEST(Hysteresis, OfAFunctionOfTheInputIsZero) {
  const std::vector<double> t = sample_times(101, 0.0626);
  const std::vector<double> in = sampled(t, [](double at) { return std::sin(at / 2); });
  std::vector<double> out;
  for (const double value : in) out.push_back(2 * value + 1);
  EXPECT_NEAR(hysteresis_of(in, out), 0, 1e-12);
  EXPECT_TRUE(std::isnan(hysteresis_of(in, std::vector<double>(101, 1.0))));
  EXPECT_THROW(hysteresis_of(in, {1.0}), std::invalid_argument);
}

TEST(AlongFarthest, IsTheComponentThatEndsFarthest) {
  Points path(4, 3);
  path << 1, 1, 1, 1, 3, 1, 5, 4, 1, 1, 1, 1;
  const std::vector<double> along = along_farthest(path);
  EXPECT_DOUBLE_EQ(along[0], 0);
  EXPECT_DOUBLE_EQ(along[1], 2 * 0.6);
  EXPECT_DOUBLE_EQ(along[2], 5);
  EXPECT_DOUBLE_EQ(along[3], 0);
}

}  // namespace
}  // namespace hyperex::metrics
