// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "hyperex/geometry/cut_surface.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

test::Sheet curved() {
  return test::sheet_mesh({10, 8}, {0.10, 0.08},
                          [](double x, double y) { return 3 * x * y - 2 * x * x; });
}

/// A path from left to right with a step up in the middle.
std::vector<int> stepped(const test::Sheet& sheet) {
  std::vector<int> path;
  for (int i = 2; i <= 5; ++i) path.push_back(sheet.vertex(i, 4));
  for (int i = 5; i <= 8; ++i) path.push_back(sheet.vertex(i, 5));
  return path;
}

TEST(CutAlong, DoublesEveryVertexBetweenTheEnds) {
  const test::Sheet sheet = curved();
  const std::vector<int> path = stepped(sheet);
  const CutSurface cut = cut_along(sheet.mesh, path);
  ASSERT_EQ(cut.appended.size(), path.size() - 2);
  const Eigen::Index old = sheet.mesh.points.rows();
  ASSERT_EQ(cut.mesh.points.rows(), old + static_cast<Eigen::Index>(path.size()) - 2);
  EXPECT_EQ(cut.mesh.points.topRows(old), sheet.mesh.points);
  EXPECT_EQ(cut.left_rim, path);
  EXPECT_EQ(cut.right_rim.front(), path.front());
  EXPECT_EQ(cut.right_rim.back(), path.back());
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    EXPECT_EQ(cut.right_rim[i], old + static_cast<Eigen::Index>(i) - 1);
    EXPECT_EQ(cut.appended[i - 1].a, path[i]);
    EXPECT_EQ(cut.appended[i - 1].t, 0);
    EXPECT_EQ(cut.mesh.points.row(cut.right_rim[i]), sheet.mesh.points.row(path[i]));
  }
}

TEST(CutAlong, KeepsTrianglesInPlaceOrderAndOrientation) {
  const test::Sheet sheet = curved();
  const CutSurface cut = cut_along(sheet.mesh, stepped(sheet));
  ASSERT_EQ(cut.mesh.triangles.rows(), sheet.mesh.triangles.rows());
  for (Eigen::Index f = 0; f < cut.mesh.triangles.rows(); ++f) {
    EXPECT_EQ(cut.source_triangle[f], f);
    for (int k = 0; k < 3; ++k)
      EXPECT_EQ(cut.mesh.points.row(cut.mesh.triangles(f, k)),
                sheet.mesh.points.row(sheet.mesh.triangles(f, k)));
  }
}

TEST(CutAlong, OpensOneMoreBorderLoop) {
  const test::Sheet sheet = curved();
  const std::vector<int> path = stepped(sheet);
  const CutSurface cut = cut_along(sheet.mesh, path);
  auto loops = boundary_loops(cut.mesh.triangles);
  ASSERT_EQ(loops.size(), boundary_loops(sheet.mesh.triangles).size() + 1);
  const auto& slit = loops[0].size() < loops[1].size() ? loops[0] : loops[1];
  EXPECT_EQ(slit.size(), 2 * (path.size() - 1));
}

TEST(CutAlong, TheRightOfTheWalkTakesTheCopy) {
  const test::Sheet sheet = curved();
  const CutSurface cut = cut_along(sheet.mesh, stepped(sheet));
  const auto fans = vertex_triangles(cut.mesh.triangles, cut.mesh.points.rows());
  const std::size_t middle = 2;  // on the straight part, walking towards +x
  const auto mean_y = [&](int v) {
    double sum = 0;
    for (int f : fans[v])
      for (int k = 0; k < 3; ++k)
        sum += cut.mesh.points(cut.mesh.triangles(f, k), 1) / (3 * double(fans[v].size()));
    return sum;
  };
  EXPECT_GT(mean_y(cut.left_rim[middle]), cut.mesh.points(cut.left_rim[middle], 1));
  EXPECT_LT(mean_y(cut.right_rim[middle]), cut.mesh.points(cut.left_rim[middle], 1));
}

TEST(CutAlong, AShortPathOpensNothing) {
  const test::Sheet sheet = curved();
  const CutSurface cut = cut_along(sheet.mesh, {sheet.vertex(4, 4), sheet.vertex(5, 4)});
  EXPECT_TRUE(cut.appended.empty());
  EXPECT_EQ(cut.mesh.triangles, sheet.mesh.triangles);
}

TEST(CutAlong, RefusesBordersAndGaps) {
  const test::Sheet sheet = curved();
  const auto v = [&](int i, int j) { return sheet.vertex(i, j); };
  EXPECT_THROW(cut_along(sheet.mesh, {v(2, 0), v(3, 0), v(4, 0)}), std::invalid_argument)
      << "along the border";
  EXPECT_THROW(cut_along(sheet.mesh, {v(2, 4), v(3, 4), v(5, 4)}), std::invalid_argument)
      << "no edge from the second to the third";
}

}  // namespace
}  // namespace hyperex
