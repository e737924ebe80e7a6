// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/rbf.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace hyperex {
namespace {

Points random_points(int count, unsigned seed) {
  std::srand(seed);
  return Points::Random(count, 3);
}

TEST(Rbf, MeetsTheData) {
  const Points centres = random_points(60, 1), values = random_points(60, 2);
  for (const auto polynomial : {RbfPolynomial::constant, RbfPolynomial::affine}) {
    const Rbf rbf(centres, values, {.polynomial = polynomial});
    EXPECT_LT((rbf.at_all(centres) - values).cwiseAbs().maxCoeff(), 1e-11);
    EXPECT_LT((rbf.at(Vec3(centres.row(7))) - Vec3(values.row(7))).norm(), 1e-11);
  }
}

TEST(Rbf, ReproducesConstants) {
  const Vec3 constant(1, -2, 3);
  const Points centres = random_points(20, 3);
  const Rbf rbf(centres, constant.transpose().replicate(20, 1));
  const Points x = 10 * random_points(50, 4);
  EXPECT_LT((rbf.at_all(x).rowwise() - constant.transpose()).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(Rbf, ReproducesAffineMapsOnlyWithTheAffineTerm) {
  Eigen::Matrix3d map;
  map << 1, 2, 3, -1, 0.5, 2, 0, 1, -2;
  const Points centres = random_points(30, 5), x = 3 * random_points(50, 6);
  const Points values = (centres * map).rowwise() + Eigen::RowVector3d(4, 5, 6);
  const Points expected = (x * map).rowwise() + Eigen::RowVector3d(4, 5, 6);
  const Rbf affine(centres, values, {.polynomial = RbfPolynomial::affine});
  EXPECT_LT((affine.at_all(x) - expected).cwiseAbs().maxCoeff(), 1e-10);
  const Rbf constant(centres, values);
  EXPECT_GT((constant.at_all(x) - expected).cwiseAbs().maxCoeff(), 0.1);
}

TEST(Rbf, IsTheKernelSumInTheSimplestCase) {
  // Two centres at distance 2 with values -1 and 1: w = (1/2, -1/2), no constant, so that between
  // them the interpolant is the straight line and beyond them it stays.
  Points centres(2, 3), values(2, 3);
  centres << -1, 0, 0, 1, 0, 0;
  values << -1, 0, 0, 1, 0, 0;
  const Rbf rbf(centres, values);
  EXPECT_NEAR(rbf.at(Vec3(0.3, 0, 0))[0], 0.3, 1e-14);
  EXPECT_NEAR(rbf.at(Vec3(5, 0, 0))[0], 1, 1e-14);
}

TEST(Rbf, MergesDuplicatesToTheirMean) {
  Points centres = random_points(10, 7), values = random_points(10, 8);
  centres.row(9) = centres.row(2);
  const Rbf rbf(centres, values);
  EXPECT_EQ(rbf.centre_count(), 9);
  const Vec3 mean = (values.row(2) + values.row(9)).transpose() / 2;
  EXPECT_LT((rbf.at(Vec3(centres.row(2))) - mean).norm(), 1e-12);
}

TEST(Rbf, SmoothingFollowsNoiseLess) {
  const Points centres = random_points(200, 9), noise = random_points(200, 10);
  double last = 0;
  for (const double smoothing : {0.0, 0.1, 1.0, 100.0}) {
    const Rbf rbf(centres, noise, {.smoothing = smoothing});
    const double residual = (rbf.at_all(centres) - noise).norm();
    EXPECT_GE(residual, last);
    last = residual;
  }
  // In the limit only the mean is left.
  const double limit = (noise.rowwise() - noise.colwise().mean()).norm();
  EXPECT_NEAR(last, limit, 0.1 * limit);
}

TEST(Rbf, CentresInOnePlaneKeepTheAffineTermFinite) {
  Points centres = random_points(15, 11);
  centres.col(2).setConstant(0.5);
  const Points values = 2 * centres;
  const Rbf rbf(centres, values, {.polynomial = RbfPolynomial::affine});
  EXPECT_LT((rbf.at_all(centres) - values).cwiseAbs().maxCoeff(), 1e-10);
  const Rbf one(centres.topRows(1), values.topRows(1), {.polynomial = RbfPolynomial::affine});
  EXPECT_LT((one.at(Vec3(7, 8, 9)) - Vec3(values.row(0))).norm(), 1e-12);
}

TEST(Rbf, RefusesBadInput) {
  EXPECT_THROW(Rbf(Points(0, 3), Points(0, 3)), std::invalid_argument);
  EXPECT_THROW(Rbf(random_points(3, 1), random_points(2, 1)), std::invalid_argument);
  EXPECT_THROW(Rbf(random_points(3, 1), random_points(3, 1), {.smoothing = -1}),
               std::invalid_argument);
}

}  // namespace
}  // namespace hyperex
