// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/iso_surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::ct {
namespace {

constexpr double kRadius = 0.02;

/// A ball whose value falls by 100 per millimetre; 0 on it.
Volume ball_of(const Eigen::Matrix3d& step_m) {
  Volume out;
  out.size = {40, 44, 42};
  out.step_m = step_m;
  out.origin_m = -step_m * Vec3(19.6, 21.4, 20.7);
  for (int k = 0; k < out.size[2]; ++k)
    for (int j = 0; j < out.size[1]; ++j)
      for (int i = 0; i < out.size[0]; ++i)
        out.hu.push_back(float(1e5 * (kRadius - out.place(i, j, k).norm())));
  return out;
}

double volume_of_mesh(const TriMesh& mesh) {
  double sum = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

void expect_ball(const Eigen::Matrix3d& step_m) {
  const TriMesh mesh = iso_surface(ball_of(step_m), 0);
  ASSERT_GT(mesh.triangles.rows(), 1000);
  EXPECT_TRUE(boundary_loops(mesh.triangles).empty());
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
    ASSERT_NEAR(mesh.points.row(v).norm(), kRadius, 5e-5);
  const double truth = 4 * std::numbers::pi / 3 * std::pow(kRadius, 3);
  EXPECT_NEAR(volume_of_mesh(mesh), truth, 0.01 * truth);
  // Euler's number of a ball: vertices, less edges, plus triangles.
  EXPECT_EQ(mesh.points.rows() - mesh.triangles.rows() / 2, 2);
}

TEST(IsoSurface, LiesOnABallAndFacesOutwards) {
  expect_ball(Vec3(1.1e-3, 1.2e-3, 1.3e-3).asDiagonal());
}

TEST(IsoSurface, OfAMirroredTurnedAndShearedGridFacesOutwardsToo) {
  expect_ball(Vec3(-1.1e-3, 1.2e-3, 1.3e-3).asDiagonal());
  Eigen::Matrix3d step = Eigen::AngleAxisd(0.6, Vec3(1, 2, 3).normalized()).matrix() *
                         Vec3(1.2e-3, 1.2e-3, 1.2e-3).asDiagonal();
  step.col(2) += 0.25 * step.col(1);
  expect_ball(step);
}

TEST(IsoSurface, EndsWhereNothingWasMeasured) {
  Volume ball = ball_of(Vec3(1.1e-3, 1.2e-3, 1.3e-3).asDiagonal());
  for (int j = 0; j < ball.size[1]; ++j)
    for (int i = 0; i < ball.size[0]; ++i)
      ball.hu[ball.at(i, j, 20)] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(boundary_loops(iso_surface(ball, 0).triangles).size(), 2u);
}

TEST(IsoSurface, OfNothingIsEmpty) {
  const Volume ball = ball_of(Vec3(1.1e-3, 1.2e-3, 1.3e-3).asDiagonal());
  EXPECT_EQ(iso_surface(ball, 1e6).triangles.rows(), 0);
  EXPECT_EQ(iso_surface(ball, -1e6).triangles.rows(), 0);
}

}  // namespace
}  // namespace hyperex::ct
