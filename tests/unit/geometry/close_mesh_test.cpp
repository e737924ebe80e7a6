// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/close_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/geometry/mesh_distance.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

/// The wall of a cup of radius 1 and height 2 about z, with or without its bottom, with `count`
/// corners around.
TriMesh cup(int count, bool with_bottom) {
  TriMesh mesh{Points(2 * count + 1, 3), Triangles((with_bottom ? 3 : 2) * count, 3)};
  for (int i = 0; i < count; ++i) {
    const double turn = 2 * M_PI * i / count;
    mesh.points.row(i) << std::cos(turn), std::sin(turn), 0;
    mesh.points.row(count + i) << std::cos(turn), std::sin(turn), 2;
  }
  mesh.points.row(2 * count).setZero();
  for (int i = 0; i < count; ++i) {
    const int next = (i + 1) % count;
    mesh.triangles.row(2 * i) << i, next, count + next;
    mesh.triangles.row(2 * i + 1) << i, count + next, count + i;
    if (with_bottom) mesh.triangles.row(2 * count + i) << 2 * count, next, i;
  }
  return mesh;
}

TEST(CloseMesh, FillsWhatIsOpen) {
  for (const bool bottom : {true, false}) {
    TriMesh mesh = cup(48, bottom);
    const Closing closing = close_mesh(mesh);
    EXPECT_EQ(closing.why_not, "");
    EXPECT_EQ(closing.borders, bottom ? 1 : 2);
    EXPECT_NEAR(closing.longest_m, 2 * M_PI, 0.01);
    EXPECT_TRUE(boundary_loops(mesh.triangles).empty());
    EXPECT_NEAR(MeshDistance(mesh).at({0, 0, 1.9}), -0.1, 1e-3);
    EXPECT_NEAR(MeshDistance(mesh).at({0, 0, 2.5}), 0.5, 1e-3);
  }
}

/// A bent strip with one border that runs around corners: a patch across a corner would use
/// existing edges.
TEST(CloseMesh, FillsTheOneBorderOfAStrip) {
  constexpr int along = 60, across = 9;
  TriMesh mesh{Points(along * across, 3), Triangles(2 * (along - 1) * (across - 1), 3)};
  for (int i = 0; i < along; ++i)
    for (int j = 0; j < across; ++j) {
      const double s = M_PI * i / (along - 1), t = M_PI * j / (across - 1);
      const double out = 3 + 0.6 * std::cos(t);
      mesh.points.row(i * across + j) << out * std::cos(s), out * std::sin(s), 0.8 * std::sin(t);
    }
  Eigen::Index f = 0;
  for (int i = 0; i + 1 < along; ++i)
    for (int j = 0; j + 1 < across; ++j) {
      const int a = i * across + j;
      mesh.triangles.row(f++) << a, a + across, a + 1;
      mesh.triangles.row(f++) << a + 1, a + across, a + across + 1;
    }
  const Closing closing = close_mesh(mesh);
  EXPECT_EQ(closing.why_not, "");
  EXPECT_EQ(closing.borders, 1);
  EXPECT_TRUE(boundary_loops(mesh.triangles).empty());
  const MeshDistance distance(mesh);
  EXPECT_LT(distance.at({0, 3, 0.4}), -0.1);
  EXPECT_GT(distance.at({0, 3, 1.2}), 0.1);
  EXPECT_GT(distance.at({0, 1, 0.2}), 0.5) << "within the arch, not in it";
}

TEST(CloseMesh, LeavesWhatIsClosedAndTurnsItOutwards) {
  TriMesh mesh = cup(48, true);
  close_mesh(mesh);
  const TriMesh closed = mesh;
  mesh.triangles.col(1).swap(mesh.triangles.col(2));
  EXPECT_EQ(close_mesh(mesh).borders, 0);
  EXPECT_EQ(mesh.triangles, closed.triangles);
  EXPECT_EQ(mesh.points, closed.points);
}

TEST(CloseMesh, MendsTrianglesThatAreTurnedRound) {
  TriMesh mesh = cup(48, true);
  const int of_bottom = 2 * 48 + 5;
  std::swap(mesh.triangles(of_bottom, 1), mesh.triangles(of_bottom, 2));
  EXPECT_EQ(close_mesh(mesh).why_not, "");
  EXPECT_NEAR(MeshDistance(mesh).at({0, 0, 1}), -0.998, 0.02);
}

TEST(CloseMesh, SaysWhyNot) {
  TriMesh none;
  EXPECT_NE(close_mesh(none).why_not, "");
  // Two cups of equal size, one of them with a triangle turned round: neither can be dropped.
  const TriMesh one = cup(24, true);
  TriMesh two{Points(2 * one.points.rows(), 3), Triangles(2 * one.triangles.rows(), 3)};
  two.points << one.points, one.points.rowwise() + Eigen::RowVector3d(5, 0, 0);
  two.triangles << one.triangles, one.triangles.array() + int(one.points.rows());
  std::swap(two.triangles(0, 1), two.triangles(0, 2));
  EXPECT_NE(close_mesh(two).why_not.find("it consists of several large separate"),
            std::string::npos);
}

}  // namespace
}  // namespace hyperex
