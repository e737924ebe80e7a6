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

// A joint 80 mm behind the corner, a jaw that turns by 4 degrees about it and slides by 5 mm: the
// turn alone carries the corner 5.6 mm.
TEST(WithJaw, AJawThatOnlyTurnsKeepsItsJoint) {
  const Vec3 joint(0, 0, -0.08);
  const motion::Motion corner = still_corner({0.03, 0, 0});
  const double angle = 4 * std::acos(-1) / 180;
  const Eigen::Isometry3d rest = Eigen::Isometry3d::Identity();
  const Eigen::Isometry3d open = Eigen::Translation3d(0, 0, -0.005) * Eigen::Translation3d(joint) *
                                 Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()) *
                                 Eigen::Translation3d(-joint);
  const double turned_mm = 2 * 80 * std::sin(angle / 2);
  EXPECT_GT(with_jaw_mm({rest, open}, corner, 0), turned_mm + 1);
  const auto turned = turned_about({rest, open}, joint);
  EXPECT_NEAR(with_jaw_mm(turned, corner, 0), turned_mm, 1e-9);
  EXPECT_TRUE(turned[1].linear().isApprox(open.linear()));
  // Surgery has moved the joint before: it stays there.
  const Eigen::Isometry3d moved(Eigen::Translation3d(0, 0.004, 0));
  const auto later = turned_about({moved, open}, joint);
  EXPECT_LT((later[1] * joint - moved * joint).norm(), 1e-12);
  EXPECT_TRUE(turned_about({}, joint).empty());
}

TEST(WithJaw, IsNotKnownWithoutPointOrJaw) {
  const motion::Motion corner = still_corner({0, 0, 0.05});
  EXPECT_TRUE(std::isnan(with_jaw_mm({Eigen::Isometry3d::Identity()}, corner, -1)));
  EXPECT_TRUE(std::isnan(with_jaw_mm({Eigen::Isometry3d::Identity()}, corner, 1)));
  EXPECT_TRUE(std::isnan(with_jaw_mm({}, corner, 0)));
}

}  // namespace
}  // namespace hyperex::metrics
