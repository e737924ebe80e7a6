// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/cotangent_laplacian.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/geometry/node_areas.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

/// A unit square of n x n cells with inner vertices moved, so that no two triangles are alike. The
/// height is that of a paraboloid of this curvature.
TriMesh sheet(int n, double curvature) {
  TriMesh mesh = test::sheet_mesh({n, n}, {1, 1}).mesh;
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i)
      mesh.points.row(j * (n + 1) + i).head<2>() +=
          0.2 / n * Eigen::RowVector2d(std::sin(3 * i + 5 * j), std::cos(7 * i - 2 * j));
  mesh.points.col(2) = curvature / 2 * mesh.points.leftCols<2>().rowwise().squaredNorm();
  return mesh;
}

TEST(CotangentLaplacian, OfALinearFieldIsZeroInsideAFlatSurface) {
  const int n = 12;
  const TriMesh mesh = sheet(n, 0);
  const Eigen::VectorXd field = mesh.points * Vec3(2, -3, 0);
  const Eigen::VectorXd of_field = cotangent_laplacian(mesh) * field;
  for (int j = 1; j < n; ++j)
    for (int i = 1; i < n; ++i) EXPECT_NEAR(of_field[j * (n + 1) + i], 0, 1e-12);
  // The energy is the squared gradient times the area.
  EXPECT_NEAR(field.dot(of_field), 13, 1e-10);
}

TEST(CotangentLaplacian, IsSymmetricAndOfAConstantZero) {
  const TriMesh mesh = sheet(8, 0.7);
  const Eigen::MatrixXd laplacian = cotangent_laplacian(mesh);
  EXPECT_EQ((laplacian - laplacian.transpose()).cwiseAbs().maxCoeff(), 0);
  EXPECT_LT(laplacian.rowwise().sum().cwiseAbs().maxCoeff(), 1e-12);
}

/// Of the positions it is minus twice the mean curvature times the normal, by area. With heights
/// c (x^2 + y^2) / 2 the mean curvature at the origin is c.
TEST(CotangentLaplacian, OfPositionsIsTheMeanCurvature) {
  const double curvature = 0.4;
  TriMesh mesh = sheet(40, curvature);
  mesh.points.leftCols(2).array() -= 0.5;  // the origin inside
  mesh.points.col(2) = curvature * mesh.points.leftCols(2).rowwise().squaredNorm() / 2;
  const Eigen::MatrixXd of_positions = cotangent_laplacian(mesh) * mesh.points;
  const Eigen::VectorXd area = node_areas(mesh);
  Eigen::Index middle = 0;
  mesh.points.leftCols(2).rowwise().norm().minCoeff(&middle);
  double sum = 0, of_area = 0;
  for (Eigen::Index v = 0; v < area.size(); ++v)
    if (mesh.points.row(v).head(2).norm() < 0.1) {
      sum -= of_positions(v, 2);
      of_area += area[v];
    }
  EXPECT_NEAR(sum / of_area, 2 * curvature, 0.02 * curvature);
}

TEST(CotangentLaplacian, TrianglesWithoutAreaAddNothing) {
  TriMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 2, 0, 0;
  mesh.triangles << 0, 1, 2, 0, 1, 3;
  const Eigen::MatrixXd laplacian = cotangent_laplacian(mesh);
  EXPECT_TRUE(laplacian.allFinite());
  EXPECT_EQ(laplacian.row(3).cwiseAbs().maxCoeff(), 0);
}

}  // namespace
}  // namespace hyperex
