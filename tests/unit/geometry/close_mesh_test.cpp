// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/close_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/geometry/mesh_distance.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

/// The wall of a cup of radius 1 and height 2 about z, with or without its bottom, in a cup of
/// `count` corners.
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
  for (int f = 0; f < 20; ++f) std::swap(mesh.triangles(f, 1), mesh.triangles(f, 2));
  EXPECT_EQ(close_mesh(mesh).why_not, "");
  EXPECT_NEAR(MeshDistance(mesh).at({0, 0, 1}), -0.998, 0.01);
}

TEST(CloseMesh, SaysWhyNot) {
  TriMesh none;
  EXPECT_NE(close_mesh(none).why_not, "");
}

}  // namespace
}  // namespace hyperex
