// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/with_jaw.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyperex::metrics {
namespace {

motion::Motion still_corner(const Vec3& at_m) {
  motion::Motion m;
  m.names = {"cheilion_R"};
  m.time_s = {0, 1, 2};
  m.positions.assign(3, at_m.transpose());
  return m;
}

// A point at 50 mm from the axis, a jaw that turns by 0.1 rad and back.
TEST(WithJaw, IsTheGreatestDistanceOfAPointFixedToTheJaw) {
  const motion::Motion corner = still_corner({0.02, 0, 0.05});
  const Eigen::Isometry3d rest = Eigen::Isometry3d::Identity(),
                          open(Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitX()));
  EXPECT_NEAR(with_jaw_mm({rest, open, rest}, corner, 0), 2 * 50 * std::sin(0.05), 1e-9);
  EXPECT_EQ(with_jaw_mm({rest, rest, rest}, corner, 0), 0);
}

// Surgery has moved the jaw before: only what the motion adds counts.
TEST(WithJaw, CountsFromTheFirstSample) {
  const motion::Motion corner = still_corner({0, 0, 0.05});
  const Eigen::Isometry3d moved(Eigen::Translation3d(0, 0.004, 0)),
      farther(Eigen::Translation3d(0, 0.007, 0));
  EXPECT_NEAR(with_jaw_mm({moved, farther, moved}, corner, 0), 3, 1e-9);
}

TEST(WithJaw, IsNotKnownWithoutPointOrJaw) {
  const motion::Motion corner = still_corner({0, 0, 0.05});
  EXPECT_TRUE(std::isnan(with_jaw_mm({Eigen::Isometry3d::Identity()}, corner, -1)));
  EXPECT_TRUE(std::isnan(with_jaw_mm({Eigen::Isometry3d::Identity()}, corner, 1)));
  EXPECT_TRUE(std::isnan(with_jaw_mm({}, corner, 0)));
}

}  // namespace
}  // namespace hyperex::metrics
