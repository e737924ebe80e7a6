// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/hole_filling.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

/// A curved sheet without the cells around its middle.
TriMesh holed_sheet() {
  test::Sheet sheet = test::sheet_mesh({8, 8}, {0.08, 0.08}, [](double x, double y) {
    return 2 * (x - 0.04) * (x - 0.04) - (y - 0.04) * (y - 0.04);
  });
  Triangles kept(0, 3);
  for (int f = 0; f < 128; ++f) {
    const int cell = f / 2, i = cell % 8, j = cell / 8;
    if (i >= 3 && i <= 4 && j >= 3 && j <= 5) continue;
    kept.conservativeResize(kept.rows() + 1, 3);
    kept.bottomRows(1) = sheet.mesh.triangles.row(f);
  }
  sheet.mesh.triangles = kept;
  return sheet.mesh;
}

TEST(FillHole, ClosesItWithAgreeingTriangles) {
  TriMesh mesh = holed_sheet();
  const TriMesh before = mesh;
  auto loops = boundary_loops(mesh.triangles);
  ASSERT_EQ(loops.size(), 2u);
  const auto& hole = loops[0].size() < loops[1].size() ? loops[0] : loops[1];
  ASSERT_EQ(hole.size(), 10u);
  ASSERT_TRUE(fill_hole(mesh, hole));
  EXPECT_EQ(mesh.points, before.points);
  EXPECT_EQ(mesh.triangles.rows(), before.triangles.rows() + 8) << "n - 2 triangles over n points";
  EXPECT_EQ(mesh.triangles.topRows(before.triangles.rows()), before.triangles);
  EXPECT_EQ(boundary_loops(mesh.triangles).size(), 1u)
      << "triangles turned against their neighbours would leave border edges";
  const Points normals = vertex_normals(mesh);
  for (const auto& n : normals.rowwise())
    if (n.norm() > 0) {  // two vertices lie unused within the hole
      EXPECT_GT(n.z(), 0.9);
    }
  EXPECT_NEAR(triangle_areas(mesh).sum(), 0.0064, 0.0001);
}

TEST(FillHole, ChangesNothingWhereThereIsNoHole) {
  TriMesh mesh = holed_sheet();
  const TriMesh before = mesh;
  EXPECT_FALSE(fill_hole(mesh, {0, 1}));
  EXPECT_EQ(mesh.triangles, before.triangles);
}

}  // namespace
}  // namespace hyperex
