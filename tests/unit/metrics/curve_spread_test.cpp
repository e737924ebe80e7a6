// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/curve_spread.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyperex::metrics {
namespace {

// A curve with the given xi_L - xi_R, sampled every 0.1 s.
SymmetryCurve curve_of(const std::vector<double>& difference) {
  SymmetryCurve curve;
  for (std::size_t k = 0; k < difference.size(); ++k) {
    curve.time_s.push_back(0.1 * double(k));
    curve.xi_left.push_back(0.5 + difference[k]);
    curve.xi_right.push_back(0.5);
  }
  return curve;
}

TEST(CurveSpread, IsTheLogarithmOfTheRatioOfDifferences) {
  const std::vector<double> spread = spread_of(
      {curve_of({0, 1e-3, -4e-3}), curve_of({0, -2e-3, 1e-3}), curve_of({0, 3e-3, 2e-3})});
  EXPECT_TRUE(std::isnan(spread[0]));  // no difference: S is its floor
  EXPECT_NEAR(spread[1], std::log(3), 1e-9);
  EXPECT_NEAR(spread[2], std::log(4), 1e-9);
  EXPECT_EQ(greatest_sample(spread), 2);
}

TEST(CurveSpread, IsNotToldWhereAnyCurveIsUnclearOrUnmeasured) {
  const SymmetryCurve clear = curve_of({1e-3, 1e-3, 1e-3});
  const SymmetryCurve other = curve_of({2e-3, 0.9e-5, std::nan("")});
  for (const auto& curves : {std::vector{clear, other}, std::vector{other, clear}}) {
    const std::vector<double> spread = spread_of(curves);
    EXPECT_NEAR(spread[0], std::log(2), 1e-9);
    EXPECT_TRUE(std::isnan(spread[1]));
    EXPECT_TRUE(std::isnan(spread[2]));
  }
}

TEST(CurveSpread, ShareOfAnIntegralCutsStretchesInTwo) {
  // A triangle of area 1: from 0.5 to 1 it holds 1/8 + 1/4 of it... exactly 3/8.
  EXPECT_NEAR(share_between({0, 1, 2}, {0, -1, 0}, 0.5, 1), 0.375, 1e-12);
  EXPECT_NEAR(share_between({0, 1, 2}, {0, 1, 0}, 0, 2), 1, 1e-12);
  EXPECT_NEAR(share_between({0, 1, 2, 3}, {std::nan(""), 1, 1, 1}, 0, 2), 0.5, 1e-12);
  EXPECT_TRUE(std::isnan(share_between({0, 1}, {0, 0}, 0, 1)));
  EXPECT_THROW(share_between({0, 1}, {0}, 0, 1), std::invalid_argument);
}

TEST(CurveSpread, RefusesCurvesOfDifferentLengths) {
  EXPECT_THROW(spread_of({}), std::invalid_argument);
  EXPECT_THROW(spread_of({curve_of({1, 1}), curve_of({1})}), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::metrics
