// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/short_border_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hyperex/geometry/cut_surface.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

constexpr double edge = 0.004;

GradedSize even() {
  GradedSize size;  // nearly the same everywhere: the centre is far off
  size.edge_m = edge;
  size.focus = {0.02, 0.02, 0};
  size.centre = {0.02, 0.02, 100};
  return size;
}

/// A sheet with a slit along its middle row. The rims beside the slit's left end are drawn
/// together, as after smoothing of folds.
struct Slit {
  TriMesh mesh;
  int end = 0;
};
Slit slit(double share) {
  const test::Sheet sheet = test::sheet_mesh({10, 10}, {10 * edge, 10 * edge});
  std::vector<int> path;
  for (int i = 3; i <= 7; ++i) path.push_back(sheet.vertex(i, 5));
  Slit out{cut_along(sheet.mesh, path).mesh, sheet.vertex(3, 5)};
  const Vec3 end = out.mesh.points.row(out.end);
  for (Eigen::Index v = 0; v < out.mesh.points.rows(); ++v) {
    const Vec3 from_end = out.mesh.points.row(v).transpose() - end;
    if ((from_end - Vec3(edge, 0, 0)).norm() < 1e-9)
      out.mesh.points.row(v) = (end + share * from_end).transpose();
  }
  return out;
}

double shortest_border_edge(const TriMesh& mesh) {
  double shortest = 1;
  for (const auto& loop : boundary_loops(mesh.triangles))
    for (std::size_t i = 0; i < loop.size(); ++i)
      shortest = std::min(
          shortest,
          (mesh.points.row(loop[i]) - mesh.points.row(loop[(i + 1) % loop.size()])).norm());
  return shortest;
}

TEST(ShortBorderEdges, AtTheEndOfASlitAreJoinedIntoItsEnd) {
  Slit at = slit(0.15);
  const Vec3 end = at.mesh.points.row(at.end);
  const double area = triangle_areas(at.mesh).sum();
  const Eigen::Index vertices = at.mesh.points.rows();
  ASSERT_NEAR(shortest_border_edge(at.mesh), 0.15 * edge, 1e-9);

  EXPECT_EQ(remove_short_border_edges(at.mesh, even(), 0.3), 2) << "one of either rim";
  EXPECT_EQ(at.mesh.points.rows(), vertices - 2);
  EXPECT_GT(shortest_border_edge(at.mesh), 0.9 * edge);
  EXPECT_EQ(boundary_loops(at.mesh.triangles).size(), 2u) << "outside and slit";
  EXPECT_NEAR(triangle_areas(at.mesh).sum(), area, 1e-12);
  double off = 1;
  for (const auto& loop : boundary_loops(at.mesh.triangles))
    for (const int v : loop) off = std::min(off, (at.mesh.points.row(v).transpose() - end).norm());
  EXPECT_LT(off, 1e-12) << "the slit's end keeps its place";
}

TEST(ShortBorderEdges, LongEnoughOnesStay) {
  Slit at = slit(0.5);
  const TriMesh before = at.mesh;
  EXPECT_EQ(remove_short_border_edges(at.mesh, even(), 0.3), 0);
  EXPECT_EQ(at.mesh.points, before.points);
  EXPECT_EQ(at.mesh.triangles, before.triangles);
}

TEST(ShortBorderEdges, StayWhereATriangleWouldTurnOver) {
  TriMesh mesh{Points(5, 3), Triangles(3, 3)};
  mesh.points << 0, 0, 0, 0.0005, 0, 0, 0.0002, 0.008, 0, -0.004, 0.004, 0, 0.00025, 0.002, 0;
  mesh.triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4;  // the edge 0-1 is short
  TriMesh folding = mesh;
  EXPECT_EQ(remove_short_border_edges(folding, even(), 0.3), 0) << "1 lies beyond the line 2-4";
  EXPECT_EQ(folding.points, mesh.points);
  mesh.points(2, 0) = 0.002;
  EXPECT_EQ(remove_short_border_edges(mesh, even(), 0.3), 1);
  EXPECT_GT(vertex_normals(mesh).col(2).minCoeff(), 0.99);
}

}  // namespace
}  // namespace hyperex
