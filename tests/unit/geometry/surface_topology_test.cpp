// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/surface_topology.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>

#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

using testing::ElementsAre;

/// The sheet without the cells where `gone(i, j)` is true.
test::Sheet with_holes(std::array<int, 2> cells, const std::function<bool(int, int)>& gone) {
  test::Sheet sheet = test::sheet_mesh(cells, {cells[0] * 1.0, cells[1] * 1.0});
  Triangles kept(0, 3);
  for (int j = 0, f = 0; j < cells[1]; ++j)
    for (int i = 0; i < cells[0]; ++i, f += 2) {
      if (gone(i, j)) continue;
      kept.conservativeResize(kept.rows() + 2, 3);
      kept.bottomRows(2) = sheet.mesh.triangles.middleRows(f, 2);
    }
  sheet.mesh.triangles = kept;
  return sheet;
}

TEST(BoundaryLoops, FollowTheTrianglesAroundTheSheet) {
  const test::Sheet sheet = test::sheet_mesh({2, 1}, {2, 1});
  const auto loops = boundary_loops(sheet.mesh.triangles);
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_THAT(loops[0], ElementsAre(0, 1, 2, 5, 4, 3));
}

TEST(BoundaryLoops, OneAHole) {
  const test::Sheet sheet = with_holes(
      {9, 7}, [](int i, int j) { return (i == 2 && j == 2) || (i >= 5 && i <= 6 && j == 3); });
  auto loops = boundary_loops(sheet.mesh.triangles);
  ASSERT_EQ(loops.size(), 3u);
  std::vector<std::size_t> lengths;
  std::set<std::pair<int, int>> directed;
  for (Eigen::Index f = 0; f < sheet.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      directed.insert({sheet.mesh.triangles(f, k), sheet.mesh.triangles(f, (k + 1) % 3)});
  for (const auto& loop : loops) {
    lengths.push_back(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      EXPECT_TRUE(directed.count({a, b})) << "in the direction of its triangle";
      EXPECT_FALSE(directed.count({b, a})) << "an edge of one triangle only";
    }
  }
  EXPECT_THAT(lengths, testing::UnorderedElementsAre(4u, 6u, 32u));
}

TEST(BoundaryLoops, HolesThatTouchKeepAllTheirEdges) {
  const test::Sheet sheet =
      with_holes({6, 6}, [](int i, int j) { return (i == 2 && j == 2) || (i == 3 && j == 3); });
  std::size_t edges = 0;
  for (const auto& loop : boundary_loops(sheet.mesh.triangles)) edges += loop.size();
  EXPECT_EQ(edges, 24u + 4u + 4u);
}

TEST(BoundaryLoops, NoneOnAClosedSurface) {
  Triangles tetrahedron(4, 3);
  tetrahedron << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  EXPECT_TRUE(boundary_loops(tetrahedron).empty());
  EXPECT_TRUE(boundary_loops(Triangles(0, 3)).empty());
}

TEST(VertexNeighbours, SortedAndUnique) {
  const test::Sheet sheet = test::sheet_mesh({2, 2}, {2, 2});
  const auto around = vertex_neighbours(sheet.mesh.triangles, 10);  // the tenth is in no triangle
  EXPECT_THAT(around[4], ElementsAre(0, 1, 3, 5, 7, 8));
  EXPECT_THAT(around[0], ElementsAre(1, 3, 4));
  EXPECT_TRUE(around[9].empty());
}

TEST(VertexTriangles, InRisingOrder) {
  const test::Sheet sheet = test::sheet_mesh({2, 2}, {2, 2});
  const auto around = vertex_triangles(sheet.mesh.triangles, 9);
  EXPECT_THAT(around[4], ElementsAre(0, 1, 3, 4, 6, 7));
  EXPECT_THAT(around[2], ElementsAre(2));
}

TEST(TriangleComponents, NumberedByTheirFirstTriangle) {
  Triangles triangles(5, 3);
  triangles << 5, 6, 7, 0, 1, 2, 6, 8, 7, 2, 1, 3, 9, 10, 11;
  EXPECT_THAT(triangle_components(triangles, 12), ElementsAre(0, 1, 0, 1, 2));
}

TEST(VertexNormals, OfAPlaneAreItsNormal) {
  const Vec3 normal = Vec3(-0.3, 0.2, 1).normalized();
  const test::Sheet sheet =
      test::sheet_mesh({5, 4}, {3, 2}, [](double x, double y) { return 0.3 * x - 0.2 * y; });
  const Points normals = vertex_normals(sheet.mesh);
  for (Eigen::Index v = 0; v < normals.rows(); ++v)
    EXPECT_LT((normals.row(v).transpose() - normal).norm(), 1e-14);
}

TEST(VertexNormals, WeighByAreaAndAreZeroWithoutAny) {
  TriMesh mesh{Points(5, 3), Triangles(2, 3)};
  mesh.points << 0, 0, 0, 3, 0, 0, 0, 1, 0, 0, 0, 1, 9, 9, 9;
  mesh.triangles << 0, 1, 2, 0, 2, 3;  // areas 3/2 facing +z, 1/2 facing +x
  const Points normals = vertex_normals(mesh);
  EXPECT_LT((normals.row(0).transpose() - Vec3(1, 0, 3).normalized()).norm(), 1e-14);
  EXPECT_EQ(normals.row(4), Eigen::RowVector3d::Zero());
}

TEST(TriangleAreas, OfKnownTriangles) {
  TriMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.points << 0, 0, 0, 3, 0, 0, 0, 4, 0, 6, 0, 0;
  mesh.triangles << 0, 1, 2, 0, 1, 3;
  const Eigen::VectorXd areas = triangle_areas(mesh);
  EXPECT_DOUBLE_EQ(areas[0], 6);
  EXPECT_DOUBLE_EQ(areas[1], 0);
}

}  // namespace
}  // namespace hyperex
