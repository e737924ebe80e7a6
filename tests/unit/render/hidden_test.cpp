// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/hidden.hpp"

#include <gtest/gtest.h>

namespace hyperex::render {
namespace {

/// A square of 0.2 m at a distance of 1 m, rotated about y so that its right side is nearer.
TriMesh turned_square() {
  TriMesh mesh;
  mesh.points.resize(4, 3);
  mesh.points << -0.1, -0.1, 1.05, 0.1, -0.1, 0.95, 0.1, 0.1, 0.95, -0.1, 0.1, 1.05;
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

TEST(HiddenFromOrigin, TellsBehindFromBeforeAlongRaysNotAlongZ) {
  Points points(6, 3);
  points << 0, 0, 1.01,  // just behind
      0, 0, 0.99,        // just before
      0, 0, 1.001,       // behind by less than the bias
      0.15, 0, 2,        // far behind: its ray passes the square at x = 0.073
      0.15, 0, 1.01,     // passes the square, whose edge is at x = 0.1 at z = 0.95
      0.095, 0, 0.94;    // before the near side
  EXPECT_EQ(hidden_from_origin(turned_square(), points, 0.002),
            (std::vector<bool>{true, false, false, true, false, false}));
}

TEST(HiddenFromOrigin, AMeshHidesNoneOfItsOwnVerticesThatItSees) {
  const TriMesh mesh = turned_square();
  EXPECT_EQ(hidden_from_origin(mesh, mesh.points), std::vector<bool>(4, false));
  EXPECT_EQ(hidden_from_origin(TriMesh{mesh.points, Triangles(0, 3)}, mesh.points),
            std::vector<bool>(4, false));
  EXPECT_TRUE(hidden_from_origin(mesh, Points(0, 3)).empty());
}

}  // namespace
}  // namespace hyperex::render
