// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/cut_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

constexpr double width = 0.06, height = 0.05;
constexpr int columns = 24, rows = 20;

test::Sheet bump() {
  return test::sheet_mesh({columns, rows}, {width, height}, [](double x, double y) {
    return 0.02 * std::sin(50 * x) * std::cos(40 * y);
  });
}

/// A smooth line across the sheet towards +x that follows no edges.
double line_y(double x) {
  return 0.0262 + 0.004 * std::sin(80 * x);
}

Points wavy_line(double from = 0.012, double to = 0.049) {
  Points line(80, 3);
  for (Eigen::Index i = 0; i < line.rows(); ++i) {
    const double x = from + (to - from) * double(i) / double(line.rows() - 1);
    line.row(i) << x, line_y(x), 0.02 * std::sin(50 * x) * std::cos(40 * line_y(x));
  }
  return line;
}

/// Checks that every edge has one triangle, or two with opposite directions of the edge.
void expect_oriented_manifold(const Triangles& triangles) {
  std::set<std::pair<int, int>> used;
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      ASSERT_TRUE(used.insert({triangles(f, k), triangles(f, (k + 1) % 3)}).second);
}

TEST(CutAlongLine, OpensOneMoreBorderAndKeepsTheSurface) {
  const TriMesh sheet = bump().mesh;
  const CutSurface cut = cut_along_line(sheet, wavy_line(), Vec3::UnitZ());
  const Eigen::Index old = sheet.points.rows();
  EXPECT_TRUE(cut.mesh.points.topRows(old) == sheet.points);
  expect_oriented_manifold(cut.mesh.triangles);
  EXPECT_EQ(boundary_loops(sheet.triangles).size(), 1u);
  EXPECT_EQ(boundary_loops(cut.mesh.triangles).size(), 2u);
  const auto component = triangle_components(cut.mesh.triangles, cut.mesh.points.rows());
  EXPECT_EQ(std::set<int>(component.begin(), component.end()).size(), 1u);

  const Eigen::VectorXd before = triangle_areas(sheet), after = triangle_areas(cut.mesh);
  ASSERT_EQ(cut.source_triangle.size(), static_cast<std::size_t>(after.size()));
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(before.size());
  for (Eigen::Index f = 0; f < after.size(); ++f) sum[cut.source_triangle[f]] += after[f];
  EXPECT_LT((sum - before).cwiseAbs().maxCoeff(), 1e-12 * before.maxCoeff());
  for (Eigen::Index f = 0; f < before.size(); ++f) EXPECT_EQ(cut.source_triangle[f], f);
  // Snapping leaves each piece at least 0.15^2 of its triangle.
  for (Eigen::Index f = 0; f < after.size(); ++f)
    EXPECT_GT(after[f], 0.02 * before[cut.source_triangle[f]]) << f;
}

TEST(CutAlongLine, RimsCoincideAtRestAndFollowTheLine) {
  const TriMesh sheet = bump().mesh;
  const CutSurface cut = cut_along_line(sheet, wavy_line(), Vec3::UnitZ());
  ASSERT_EQ(cut.left_rim.size(), cut.right_rim.size());
  ASSERT_GT(cut.left_rim.size(), 20u);
  EXPECT_EQ(cut.left_rim.front(), cut.right_rim.front());
  EXPECT_EQ(cut.left_rim.back(), cut.right_rim.back());
  const double edge = width / columns;
  for (std::size_t i = 0; i < cut.left_rim.size(); ++i) {
    const Vec3 p = cut.mesh.points.row(cut.left_rim[i]);
    EXPECT_TRUE(cut.mesh.points.row(cut.right_rim[i]) == p.transpose());
    if (i > 0 && i + 1 < cut.left_rim.size()) {
      EXPECT_NE(cut.left_rim[i], cut.right_rim[i]);
    }
    EXPECT_LT(std::abs(p.y() - line_y(p.x())), 0.25 * edge) << i;
  }
  const Points line = wavy_line();
  for (const auto& [end, vertex] : {std::pair<Eigen::Index, int>{0, cut.left_rim.front()},
                                    {line.rows() - 1, cut.left_rim.back()}})
    EXPECT_LT((cut.mesh.points.row(vertex) - line.row(end)).norm(), 0.7 * edge);
}

TEST(CutAlongLine, PartsWhatLiesLeftFromWhatLiesRight) {
  const TriMesh sheet = bump().mesh;
  const CutSurface cut = cut_along_line(sheet, wavy_line(), Vec3::UnitZ());
  const std::set<int> left(cut.left_rim.begin() + 1, cut.left_rim.end() - 1),
      right(cut.right_rim.begin() + 1, cut.right_rim.end() - 1);
  int above = 0, below = 0;
  for (Eigen::Index f = 0; f < cut.mesh.triangles.rows(); ++f) {
    const Vec3 middle = (cut.mesh.points.row(cut.mesh.triangles(f, 0)) +
                         cut.mesh.points.row(cut.mesh.triangles(f, 1)) +
                         cut.mesh.points.row(cut.mesh.triangles(f, 2))) /
                        3;
    for (int k = 0; k < 3; ++k) {
      if (left.count(cut.mesh.triangles(f, k))) {
        ++above;
        EXPECT_GT(middle.y(), line_y(middle.x()) - 1e-4);
      }
      if (right.count(cut.mesh.triangles(f, k))) {
        ++below;
        EXPECT_LT(middle.y(), line_y(middle.x()) + 1e-4);
      }
    }
  }
  EXPECT_GT(above, 40);
  EXPECT_GT(below, 40);
}

TEST(CutAlongLine, SaysWhereTheAppendedVerticesLie) {
  const TriMesh sheet = bump().mesh;
  const CutSurface cut = cut_along_line(sheet, wavy_line(), Vec3::UnitZ());
  ASSERT_EQ(sheet.points.rows() + static_cast<Eigen::Index>(cut.appended.size()),
            cut.mesh.points.rows());
  int on_vertices = 0;
  for (std::size_t i = 0; i < cut.appended.size(); ++i) {
    const EdgePoint& e = cut.appended[i];
    const Vec3 p = cut.mesh.points.row(sheet.points.rows() + static_cast<Eigen::Index>(i));
    EXPECT_LT((e.on(sheet.points) - p).norm(), 1e-15);
    if (e.a == e.b) {
      EXPECT_EQ(e.t, 0);
      ++on_vertices;
    } else {
      EXPECT_GT(e.t, 0.15);
      EXPECT_LT(e.t, 0.85);
    }
  }
  EXPECT_GT(on_vertices, 0) << "the line passes some vertex closely";
}

TEST(CutAlongLine, LeavesTheSheetBehindAlone) {
  // A second sheet 8 mm behind: the same mesh again, within the reach of the line.
  const TriMesh front = bump().mesh;
  TriMesh both = front;
  const Eigen::Index n = front.points.rows(), m = front.triangles.rows();
  both.points.conservativeResize(2 * n, 3);
  both.points.bottomRows(n) = front.points.rowwise() - Eigen::RowVector3d(0, 0, 0.004);
  both.triangles.conservativeResize(2 * m, 3);
  both.triangles.bottomRows(m) = front.triangles.array() + static_cast<int>(n);
  const CutSurface cut = cut_along_line(both, wavy_line(), Vec3::UnitZ());
  EXPECT_TRUE(cut.mesh.triangles.middleRows(m, m) == both.triangles.bottomRows(m));
  for (std::size_t f = 2 * m; f < cut.source_triangle.size(); ++f)
    EXPECT_LT(cut.source_triangle[f], m);
}

TEST(CutAlongLine, AlongTheEdgesThemselvesNeedsNoNewPlaces) {
  const test::Sheet sheet = test::sheet_mesh({columns, rows}, {width, height});
  Points line(2, 3);
  line << sheet.mesh.points.row(sheet.vertex(4, 10)), sheet.mesh.points.row(sheet.vertex(12, 10));
  const CutSurface cut = cut_along_line(sheet.mesh, line, Vec3::UnitZ());
  EXPECT_EQ(cut.mesh.triangles.rows(), sheet.mesh.triangles.rows());
  ASSERT_EQ(cut.appended.size(), 7u);
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_EQ(cut.appended[i].a, sheet.vertex(5 + static_cast<int>(i), 10));
    EXPECT_EQ(cut.left_rim[i], sheet.vertex(4 + static_cast<int>(i), 10));
  }
  EXPECT_EQ(boundary_loops(cut.mesh.triangles).size(), 2u);
}

TEST(CutAlongLine, RefusesALineThatLeavesTheSurface) {
  test::Sheet sheet = bump();
  EXPECT_THROW(cut_along_line(sheet.mesh, wavy_line().rowwise() + Eigen::RowVector3d(0, 0, 0.05),
                              Vec3::UnitZ()),
               std::invalid_argument);
  // A hole in the way.
  Triangles kept(sheet.mesh.triangles.rows(), 3);
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < kept.rows(); ++f)
    if (std::abs(sheet.mesh.points(sheet.mesh.triangles(f, 0), 0) - 0.5 * width) > 0.004)
      kept.row(count++) = sheet.mesh.triangles.row(f);
  sheet.mesh.triangles = kept.topRows(count);
  EXPECT_THROW(cut_along_line(sheet.mesh, wavy_line(), Vec3::UnitZ()), std::invalid_argument);
  EXPECT_THROW(cut_along_line(bump().mesh, Points::Zero(3, 3), Vec3::UnitZ()),
               std::invalid_argument);
}

}  // namespace
}  // namespace hyperex
