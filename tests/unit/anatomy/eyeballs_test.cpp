// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/eyeballs.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace hyperex::anatomy {
namespace {

constexpr double kEyeRadius_m = 0.012, kLidGap_m = 4e-4;

/// Eyes 30 mm wide, whose balls begin 7 mm behind the line of their corners.
FaceCorners corners_of_two_eyes() {
  return {{Vec3(-0.045, 0, 0), Vec3(0.045, 0, 0)},
          {Vec3(-0.015, 0, 0), Vec3(0.015, 0, 0)},
          {Vec3(-0.025, -0.065, 0), Vec3(0.025, -0.065, 0)},
          Vec3::UnitZ()};
}

/// Vertices at offsets from where the balls begin: towards the nose, up, forward.
Points lids_at(const std::vector<Vec3>& offsets) {
  Points out(2 * Eigen::Index(offsets.size()), 3);
  for (std::size_t i = 0; i < offsets.size(); ++i) {
    const Vec3& off = offsets[i];
    out.row(2 * Eigen::Index(i)) << -0.03 + off.x(), off.y(), -0.007 + off.z();
    out.row(2 * Eigen::Index(i) + 1) << 0.03 - off.x(), off.y(), -0.007 + off.z();
  }
  return out;
}

/// How far forward of its beginning a place across the ball lets it be.
double room_for_ball(const Vec3& off) {
  const double reach = kEyeRadius_m + kLidGap_m;
  return off.z() - std::sqrt(reach * reach - off.head<2>().squaredNorm());
}

void expect_outside(const Points& lids, const std::vector<Eyeball>& eyes) {
  for (const auto& lid : lids.rowwise())
    for (const Eyeball& eye : eyes)
      EXPECT_GE((lid.transpose() - eye.centre).norm(), eye.radius_m + 0.99 * kLidGap_m);
}

TEST(Eyeballs, MakeWayForAVertexBesideTheEye) {
  // At the temple: without a shift it would push the ball back by 1.5 mm.
  const Vec3 temple(-0.008, 0, 0.008);
  const Points lids = lids_at({temple, {0, 0.011, 0.0065}, {0, -0.011, 0.0065}});
  const auto eyes = eyeballs_behind(lids, corners_of_two_eyes());
  ASSERT_EQ(eyes.size(), 2u);
  EXPECT_NEAR(eyes[0].radius_m, kEyeRadius_m, 1e-12);
  EXPECT_LT(room_for_ball(temple), -1.4e-3);
  EXPECT_GT(eyes[0].centre.z(), -0.007 - 0.3e-3);
  EXPECT_NEAR(eyes[0].centre.x(), -0.0285, 1e-9) << "towards the nose";
  EXPECT_NEAR(eyes[1].centre.x(), 0.0285, 1e-9);
  EXPECT_NEAR(eyes[0].centre.y(), 0, 1e-9) << "up or down would bring nothing";
  EXPECT_NEAR(eyes[1].centre.z(), eyes[0].centre.z(), 1e-9);
  expect_outside(lids, eyes);
}

TEST(Eyeballs, RiseBetweenLidsThatLieHigher) {
  const Vec3 below(0, -0.008, 0.008);
  const Points lids = lids_at({below});
  const auto eyes = eyeballs_behind(lids, corners_of_two_eyes());
  EXPECT_NEAR(eyes.at(0).centre.y(), 1.5e-3, 1e-9);
  EXPECT_NEAR(eyes[0].centre.z(), -0.007 + room_for_ball(below - Vec3(0, 1.5e-3, 0)), 1e-9);
  expect_outside(lids, eyes);
}

TEST(Eyeballs, StayWhereAShiftBringsTooLittle) {
  // In the middle, at the temple's side of the pupil: a shift by 1 mm brings 0.1 mm.
  const Vec3 middle(-0.001, 0, 0.0115);
  const auto eyes = eyeballs_behind(lids_at({middle}), corners_of_two_eyes());
  EXPECT_NEAR(eyes.at(0).centre.x(), -0.03, 1e-9);
  EXPECT_NEAR(eyes[0].centre.y(), 0, 1e-9);
  EXPECT_NEAR(eyes[0].centre.z(), -0.007 + room_for_ball(middle), 1e-9);
}

TEST(Eyeballs, ComeForwardAsFarAsLidsAllowAndNoFarther) {
  const auto at = [](const std::vector<Vec3>& lids) {
    return eyeballs_behind(lids_at(lids), corners_of_two_eyes()).at(0).centre.z() + 0.007;
  };
  EXPECT_NEAR(at({{0, 0, 0.0136}}), 0.0012, 1e-9);
  EXPECT_NEAR(at({{0, 0, 0.018}}), 0.0025, 1e-9) << "the lids are far before it";
  EXPECT_NEAR(at({{0, 0, 0.0045}}), -0.0079, 1e-9);
  EXPECT_EQ(at({}), 0) << "no lids";
}

}  // namespace
}  // namespace hyperex::anatomy
