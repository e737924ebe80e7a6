// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/lid_points.hpp"

#include <gmock/gmock.h>

#include "hyperex/session/driven_points.hpp"

namespace hyperex::session {
namespace {

/// Half of the aperture at x, mm: 5 in the middle, and `at_points_mm` at the lids' points (8 mm
/// aside).
double half_aperture_mm(double x_mm, double at_points_mm) {
  return 5 - (5 - at_points_mm) * x_mm * x_mm / 64;
}

/// Two flat lids around the opening of an eye.
TriMesh lids(double at_points_mm) {
  constexpr int columns = 33;  // every millimetre from -16 to 16
  TriMesh mesh{Points(4 * columns, 3), Triangles(4 * (columns - 1), 3)};
  for (int i = 0; i < columns; ++i) {
    const double x_mm = i - 16, half_mm = half_aperture_mm(x_mm, at_points_mm);
    const double heights_mm[] = {25, half_mm, -half_mm, -25};
    for (int row = 0; row < 4; ++row)
      mesh.points.row(4 * i + row) << 1e-3 * x_mm, 1e-3 * heights_mm[row], 0;
    if (i + 1 == columns) break;
    const int a = 4 * i;
    for (const int row : {0, 2}) {
      mesh.triangles.row(4 * i + row) << a + row, a + row + 1, a + row + 5;
      mesh.triangles.row(4 * i + row + 1) << a + row, a + row + 5, a + row + 4;
    }
  }
  return mesh;
}

/// The left eye's lids, at rest and closed: six sevenths of the way are the upper lid's.
simulate::AlignedMotion blink(double at_points_mm) {
  simulate::AlignedMotion aligned;
  aligned.motion.names = {"ibug68_43", "ibug68_44", "ibug68_47", "ibug68_46"};
  aligned.motion.time_s = {0, 0.1};
  const double up = 1e-3 * at_points_mm;
  Points rest(4, 3), closed(4, 3);
  rest << -0.008, up, 0, 0.008, up, 0, -0.008, -up, 0, 0.008, -up, 0;
  closed = rest;
  closed.col(1).head(2).array() -= 12.0 / 7 * up;
  closed.col(1).tail(2).array() += 2.0 / 7 * up;
  aligned.motion.positions = {rest, closed};
  aligned.rest = rest;
  return aligned;
}

TEST(LidPoints, CloseWhereTheEyeIsWidest) {
  simulate::AlignedMotion aligned = blink(3.6);
  add_lid_points(aligned, lids(3.6), Eigen::Matrix3d::Identity());
  ASSERT_EQ(aligned.motion.names.size(), 6u);
  EXPECT_EQ(aligned.motion.names[4], "lid_middle_upper_L");
  EXPECT_EQ(aligned.motion.names[5], "lid_middle_lower_L");
  const auto gap_mm = [&](const Points& at) { return 1e3 * (at(4, 1) - at(5, 1)); };
  EXPECT_NEAR(gap_mm(aligned.rest), 10, 0.3);
  EXPECT_EQ(aligned.motion.positions[0], aligned.rest);
  EXPECT_NEAR(gap_mm(aligned.motion.positions[1]), 0, 1e-9);
}

TEST(LidPoints, AreNotAddedWhereTheLidsPointsCloseTheEye) {
  simulate::AlignedMotion aligned = blink(4.5);
  add_lid_points(aligned, lids(4.5), Eigen::Matrix3d::Identity());
  EXPECT_EQ(aligned.motion.names.size(), 4u);
}

/// With the inner corner, which stays, at x.
simulate::AlignedMotion with_corner(simulate::AlignedMotion aligned, double x_mm) {
  const auto append = [&](Points& points) {
    points.conservativeResize(points.rows() + 1, 3);
    points.bottomRows(1) << 1e-3 * x_mm, 0, 0;
  };
  for (Points& now : aligned.motion.positions) append(now);
  append(aligned.rest);
  aligned.motion.names.push_back("ibug68_42");
  return aligned;
}

/// The lids meet at 15 mm.
TEST(LidPoints, CloseBesideAnInnerCornerWhoseLandmarkLiesTooFarIn) {
  simulate::AlignedMotion aligned = with_corner(blink(3.6), -12.5);
  add_lid_points(aligned, lids(3.6), Eigen::Matrix3d::Identity());
  const int upper = aligned.motion.index_of("lid_inner_upper_L"),
            lower = aligned.motion.index_of("lid_inner_lower_L");
  ASSERT_GE(upper, 0);
  ASSERT_GE(lower, 0);
  const auto gap_mm = [&](const Points& at) { return 1e3 * (at(upper, 1) - at(lower, 1)); };
  EXPECT_NEAR(1e3 * aligned.rest(upper, 0), -10.25, 0.5);
  EXPECT_NEAR(gap_mm(aligned.rest), 2 * half_aperture_mm(-10.25, 3.6), 0.3);
  EXPECT_NEAR(gap_mm(aligned.motion.positions[1]), 0, 1e-9);
}

TEST(LidPoints, AreNotAddedBesideACornerWhereTheLidsMeet) {
  simulate::AlignedMotion aligned = with_corner(blink(3.6), -15);
  add_lid_points(aligned, lids(3.6), Eigen::Matrix3d::Identity());
  EXPECT_EQ(aligned.motion.index_of("lid_inner_upper_L"), -1);
}

TEST(LidPoints, AreDrivenWithTheLids) {
  simulate::AlignedMotion aligned = blink(3.6);
  add_lid_points(aligned, lids(3.6), Eigen::Matrix3d::Identity());
  EXPECT_THAT(driven_points(scene::Scene(), aligned.motion),
              testing::IsSupersetOf({"lid_middle_upper_L", "lid_middle_lower_L"}));
}

}  // namespace
}  // namespace hyperex::session
