// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/plane_section.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyperex {
namespace {

TriMesh octahedron() {
  TriMesh mesh;
  mesh.points.resize(6, 3);
  mesh.points << 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1;
  mesh.triangles.resize(8, 3);
  mesh.triangles << 0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 1, 0, 5, 2, 1, 5, 3, 2, 5, 0, 3, 5;
  return mesh;
}

double length(const Points& segments) {
  double sum = 0;
  for (Eigen::Index i = 0; i + 1 < segments.rows(); i += 2)
    sum += (segments.row(i) - segments.row(i + 1)).norm();
  return sum;
}

TEST(PlaneSection, OfAnOctahedronIsASquareOnThePlane) {
  const Points section = plane_section(octahedron(), {0, 0, 0.25}, 3 * Vec3::UnitZ());
  ASSERT_EQ(section.rows(), 8);
  EXPECT_LT((section.col(2).array() - 0.25).abs().maxCoeff(), 1e-15);
  EXPECT_NEAR(length(section), 4 * 0.75 * std::sqrt(2), 1e-14);
}

TEST(PlaneSection, ThroughVerticesIsWholeToo) {
  const Points section = plane_section(octahedron(), Vec3::Zero(), Vec3::UnitZ());
  EXPECT_NEAR(length(section), 4 * std::sqrt(2), 1e-14);
}

TEST(PlaneSection, BesideTheSurfaceIsEmpty) {
  EXPECT_EQ(plane_section(octahedron(), {0, 0, 1.5}, Vec3::UnitZ()).rows(), 0);
}

}  // namespace
}  // namespace hyperex
