// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/element/tet4.hpp"

#include <gtest/gtest.h>

#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

Eigen::Matrix<double, 4, 3> skewed_corners() {
  Eigen::Matrix<double, 4, 3> c;
  c << 0.1, 0.2, -0.1, 1.3, 0.1, 0.2, 0.3, 0.9, 0.0, 0.2, 0.4, 1.1;
  return c;
}

TEST(Tet4, ShapeFunctionsInterpolateLinearFieldsExactly) {
  const auto corner = skewed_corners();
  const Tet4 tet = make_tet4(corner);
  const Eigen::Vector3d slope(2, -3, 0.5);
  const Eigen::Vector4d value = corner * slope;
  EXPECT_LT((tet.gradient.transpose() * value - slope).norm(), 1e-14);
  EXPECT_LT(tet.gradient.colwise().sum().norm(), 1e-14);
}

TEST(Tet4, VolumeIsSigned) {
  auto corner = skewed_corners();
  const double volume = make_tet4(corner).volume;
  const Points nodes = corner;
  const Tetrahedra tet = (Tetrahedra(1, 4) << 0, 1, 2, 3).finished();
  EXPECT_NEAR(volume, test::volume_of(nodes, tet, 0), 1e-15);
  EXPECT_GT(volume, 0);
  corner.row(2).swap(corner.row(3));
  EXPECT_NEAR(make_tet4(corner).volume, -volume, 1e-15);
}

TEST(Tet4, StrainIsTheSymmetricGradientWithEngineeringShear) {
  const auto corner = skewed_corners();
  Eigen::Matrix3d g;
  g << 0.1, 0.2, -0.3, 0.05, -0.2, 0.4, 0.15, 0.25, 0.35;
  const Eigen::Matrix<double, 4, 3> d = corner * g.transpose();
  const Eigen::Matrix<double, 6, 1> strain = strain_of(make_tet4(corner).gradient, d);
  const double expected[6] = {g(0, 0),           g(1, 1),           g(2, 2),
                              g(0, 1) + g(1, 0), g(1, 2) + g(2, 1), g(2, 0) + g(0, 2)};
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(strain[i], expected[i], 1e-14) << i;
}

TEST(Tet4, MassIsTheIntegralOfTheShapeFunctionsProducts) {
  const Tet4 tet = make_tet4(skewed_corners());
  const Eigen::Matrix4d rule = test::quadratic_rule();
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < 4; ++b) {
      double integral = 0;
      for (int q = 0; q < 4; ++q) integral += tet.volume / 4 * rule(q, a) * rule(q, b);
      EXPECT_NEAR(mass_entry(tet, 1100, a, b), 1100 * integral, 1e-12);
    }
}

}  // namespace
}  // namespace hyperex::fem
