// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/variant_difference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace hyperex::metrics {
namespace {

/// Two vertices, three frames. The second vertex of b moves sideways by 3 mm in frame 1 and by 4 mm
/// in frame 2.
std::vector<PointsF> frames(bool of_b) {
  std::vector<PointsF> all(3, PointsF::Zero(2, 3));
  for (int f = 0; f < 3; ++f) all[f](1, 1) = 0.004F * float(f);
  if (of_b) {
    all[1](1, 0) = 0.003F;
    all[2](1, 1) -= 0.004F;
  }
  return all;
}

TEST(VariantDifference, IsKnownForTwoVertices) {
  const VariantDifference d = variant_difference(frames(false), frames(true), 1);
  EXPECT_NEAR(d.greatest_m[0], 0, 1e-12);
  EXPECT_NEAR(d.greatest_m[1], 0.004, 1e-9);
  EXPECT_NEAR(d.at_peak_m[1], 0.003, 1e-9);
  EXPECT_NEAR(d.rms_m[1], std::sqrt((9e-6 + 16e-6) / 3), 1e-9);
  EXPECT_NEAR(d.change_at_peak_m[1], 0.001, 1e-9);  // from 4 to 5 mm
  EXPECT_NEAR(variant_difference(frames(false), frames(true), 2).change_at_peak_m[1], -0.004, 1e-9);
  EXPECT_NEAR(d.frame_rms_m[2], 0.004 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(d.frame_max_m[2], 0.004, 1e-9);
  EXPECT_EQ(variant_difference(frames(true), frames(true), 0).greatest_m.maxCoeff(), 0);
}

TEST(VariantDifference, RefusesWhatDoesNotFit) {
  std::vector<PointsF> less = frames(true);
  less.pop_back();
  EXPECT_THROW(variant_difference(frames(false), less, 0), std::invalid_argument);
  EXPECT_THROW(variant_difference({}, {}, 0), std::invalid_argument);
  EXPECT_THROW(variant_difference(frames(false), frames(true), 3), std::invalid_argument);
  less.push_back(PointsF::Zero(3, 3));
  EXPECT_THROW(variant_difference(frames(false), less, 0), std::invalid_argument);
}

TEST(ShareWithin, CountsSquaresNearThePlace) {
  Points rest(3, 3);
  rest << 0, 0, 0, 0.02, 0, 0, 0.03, 0, 0;
  const Eigen::VectorXd distance = Eigen::Vector3d(1, 2, 3) * 1e-3;
  EXPECT_NEAR(share_within(distance, rest, Points::Zero(1, 3), 0.025), 5.0 / 14, 1e-12);
  EXPECT_NEAR(share_within(distance, rest, Points::Zero(1, 3), 0.025, Eigen::Vector3d(2, 1, 0.5)),
              6 / 10.5, 1e-12);
  EXPECT_TRUE(std::isnan(share_within(Eigen::Vector3d::Zero(), rest, Points::Zero(1, 3), 1)));
  EXPECT_THROW(share_within(Eigen::Vector2d::Zero(), rest, Points::Zero(1, 3), 1),
               std::invalid_argument);
  EXPECT_THROW(share_within(distance, rest, Points(0, 3), 1), std::invalid_argument);
}

// A mouth 60 mm wide: a point 20 mm outside a corner is near the outline, although it is 50 mm from
// the middle.
TEST(ShareWithin, MeasuresFromTheOutline) {
  Points outline(4, 3), rest(3, 3);
  outline << -0.03, 0, 0, 0, 0.01, 0, 0.03, 0, 0, 0, -0.01, 0;
  rest << 0.05, 0, 0,    // 20 mm from the left corner
      -0.015, 0.029, 0,  // 22.8 mm from the upper edge, between two of its points, 24.2 from those
      0, -0.04, 0;       // 30 mm below
  const Eigen::VectorXd distance = Eigen::Vector3d(1, 2, 3) * 1e-3;
  EXPECT_NEAR(share_within(distance, rest, outline, 0.0235), 5.0 / 14, 1e-12);
  EXPECT_NEAR(share_within(distance, rest, outline, 0.0201), 1.0 / 14, 1e-12);
  EXPECT_NEAR(share_within(distance, rest, outline, 0.031), 1, 1e-12);
}

TEST(VertexAreas, SumToTheSurface) {
  TriMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.points << 0, 0, 0, 2, 0, 0, 2, 1, 0, 0, 1, 0;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  const Eigen::VectorXd areas = vertex_areas(mesh);
  EXPECT_DOUBLE_EQ(areas.sum(), 2);
  EXPECT_DOUBLE_EQ(areas[0], 2.0 / 3);
  EXPECT_DOUBLE_EQ(areas[1], 1.0 / 3);
}

}  // namespace
}  // namespace hyperex::metrics
