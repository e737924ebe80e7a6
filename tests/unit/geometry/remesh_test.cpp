// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/remesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "hyperex/geometry/cut_surface.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

constexpr double sheet_width = 0.16, sheet_height = 0.12;

test::Sheet flat() {
  return test::sheet_mesh({40, 30}, {sheet_width, sheet_height});
}

GradedSize graded() {
  GradedSize size;
  size.edge_m = 0.004;
  size.focus = {0.08, 0.06, 0};
  size.centre = {0.08, 0.06, 0.08};
  return size;
}

/// The length of each edge divided by the wanted length at its middle.
std::vector<double> length_ratios(const TriMesh& mesh, const GradedSize& size) {
  std::vector<double> ratios;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3);
      const Vec3 p = mesh.points.row(a), q = mesh.points.row(b);
      ratios.push_back((p - q).norm() / size.at((p + q) / 2));
    }
  return ratios;
}

TEST(GradedSize, GrowsAwayFromTheFocus) {
  const GradedSize size = graded();
  EXPECT_DOUBLE_EQ(size.at(size.focus), 0.004);
  EXPECT_DOUBLE_EQ(size.at({0.16, 0.06, 0}), 0.008) << "doubled at the centre's height aside";
}

TEST(RemeshGraded, EdgesHaveTheWantedLength) {
  const GradedSize size = graded();
  const TriMesh mesh = remesh_graded(flat().mesh, size);
  const auto ratios = length_ratios(mesh, size);
  double mean = 0;
  int far_off = 0;
  for (double r : ratios) {
    mean += r / double(ratios.size());
    far_off += r < 0.6 || r > 1.5;
  }
  EXPECT_NEAR(mean, 1, 0.12);
  EXPECT_LT(far_off, 0.05 * double(ratios.size()));
  // The grading is real: triangles at the corners are larger than those at the focus.
  const Eigen::VectorXd areas = triangle_areas(mesh);
  EXPECT_GT(areas.maxCoeff(), 3 * areas.minCoeff());
}

TEST(RemeshGraded, KeepsBorderAreaAndOrientation) {
  const TriMesh mesh = remesh_graded(flat().mesh, graded());
  const auto loops = boundary_loops(mesh.triangles);
  ASSERT_EQ(loops.size(), 1u);
  for (int v : loops[0]) {
    const Vec3 p = mesh.points.row(v);
    const double off = std::min({std::abs(p.x()), std::abs(p.x() - sheet_width), std::abs(p.y()),
                                 std::abs(p.y() - sheet_height)});
    EXPECT_LT(off, 0.0005) << p.transpose();
  }
  EXPECT_NEAR(triangle_areas(mesh).sum(), sheet_width * sheet_height,
              0.02 * sheet_width * sheet_height);
  EXPECT_GT(vertex_normals(mesh).col(2).minCoeff(), 0.8);
}

TEST(RemeshGraded, ASlitStaysOpen) {
  const test::Sheet sheet = flat();
  std::vector<int> path;
  for (int i = 12; i <= 28; ++i) path.push_back(sheet.vertex(i, 15));
  const TriMesh mesh = remesh_graded(cut_along(sheet.mesh, path).mesh, graded());
  ASSERT_EQ(boundary_loops(mesh.triangles).size(), 2u);
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {  // none reaches over the slit
    double lowest = 1, highest = -1;
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const auto p = mesh.points.row(mesh.triangles(f, k));
      lowest = std::min(lowest, p.y() - 0.06);
      highest = std::max(highest, p.y() - 0.06);
      inside &= p.x() > 0.055 && p.x() < 0.105;
    }
    EXPECT_FALSE(inside && lowest < -0.001 && highest > 0.001);
  }
}

TEST(RemeshGraded, SameInputSameOutput) {
  const TriMesh a = remesh_graded(flat().mesh, graded()), b = remesh_graded(flat().mesh, graded());
  EXPECT_EQ(a.points, b.points);
  EXPECT_EQ(a.triangles, b.triangles);
}

}  // namespace
}  // namespace hyperex
