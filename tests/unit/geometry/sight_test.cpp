// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/sight.hpp"

#include <gtest/gtest.h>

#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

/// Two sheets of 20 mm that look up, the second 5 mm above the first and half as wide.
TEST(BlockedShares, CountTheDirectionsInWhichSomethingStandsInTheWay) {
  const test::Sheet low = test::sheet_mesh({8, 8}, {0.02, 0.02}),
                    high = test::sheet_mesh({4, 8}, {0.01, 0.02},
                                            [](double, double) { return 0.005; });
  TriMesh both = low.mesh;
  const Eigen::Index points = both.points.rows(), triangles = both.triangles.rows();
  both.points.conservativeResize(points + high.mesh.points.rows(), 3);
  both.points.bottomRows(high.mesh.points.rows()) = high.mesh.points;
  both.triangles.conservativeResize(triangles + high.mesh.triangles.rows(), 3);
  both.triangles.bottomRows(high.mesh.triangles.rows()) = high.mesh.triangles.array() + int(points);
  Points up_and_aside(2, 3);
  up_and_aside << 0, 0, 1, Vec3(1, 0, 0.2).normalized().transpose();
  const std::vector<int> vertices{low.vertex(2, 4), low.vertex(6, 4), int(points)};
  EXPECT_EQ(blocked_shares(both, vertices, up_and_aside, 0.03), (std::vector<double>{0.5, 0, 0}))
      << "under the upper sheet; beside it; on it";
  EXPECT_EQ(blocked_shares(both, vertices, up_and_aside.topRows(1), 0.004),
            (std::vector<double>{0, 0, 0}))
      << "5 mm are out of reach";
}

}  // namespace
}  // namespace hyperex
