// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/transform.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hyperex {
namespace {

Points random_cloud(int count, unsigned seed) {
  std::mt19937 engine(seed);
  std::normal_distribution<double> normal(0, 0.05);
  Points points(count, 3);
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] = normal(engine);
  return points;
}

Similarity some_similarity(double scale) {
  Similarity similarity;
  similarity.scale = scale;
  similarity.rotation = Eigen::AngleAxisd(2.3, Vec3(1, -2, 0.5).normalized()).toRotationMatrix();
  similarity.translation = Vec3(0.3, -0.1, 2);
  return similarity;
}

TEST(Transform, FitsAreExactOnExactData) {
  const Points a = random_cloud(7, 1);
  for (const double scale : {1.0, 0.01, 3.0}) {
    const Similarity truth = some_similarity(scale), found = fit_similarity(a, truth.apply(a));
    EXPECT_NEAR(found.scale, scale, 1e-12 * scale);
    EXPECT_LT((found.rotation - truth.rotation).norm(), 1e-12);
    EXPECT_LT((found.translation - truth.translation).norm(), 1e-12);
  }
  const Similarity truth = some_similarity(1);
  EXPECT_LT((fit_rigid(a, truth.apply(a)).linear() - truth.rotation).norm(), 1e-12);
}

TEST(Transform, ThreePointsAndMirrorImagesGiveProperRotations) {
  const Points a = random_cloud(3, 2);
  EXPECT_NEAR(fit_rigid(a, some_similarity(1).apply(a)).linear().determinant(), 1, 1e-12);
  Points mirror = random_cloud(20, 3);
  const Points b = mirror;
  mirror.col(0) *= -1;
  EXPECT_NEAR(fit_rigid(mirror, b).linear().determinant(), 1, 1e-12);
}

TEST(Transform, NoOtherTransformNearbyFitsBetter) {
  const Points a = random_cloud(12, 4);
  const Points b = some_similarity(1.2).apply(a) + 0.1 * random_cloud(12, 5);
  const Eigen::VectorXd weights = Eigen::VectorXd::LinSpaced(12, 0.1, 2);
  const Similarity found = fit_similarity(a, b, weights);
  const double least = rms_distance(found.apply(a), b, weights);
  for (int axis = 0; axis < 3; ++axis)
    for (const double step : {-1e-4, 1e-4}) {
      Similarity other = found;
      other.translation[axis] += step;
      EXPECT_GT(rms_distance(other.apply(a), b, weights), least);
      other = found;
      other.rotation = Eigen::AngleAxisd(step, Vec3::Unit(axis)) * found.rotation;
      // About the weighted middle, which an optimal fit carries onto the other's.
      const Vec3 middle = (weights.transpose() * a / weights.sum()).transpose();
      other.translation += found * middle - other * middle;
      EXPECT_GT(rms_distance(other.apply(a), b, weights), least);
      other = found;
      other.scale *= 1 + step;
      other.translation += found * middle - other * middle;
      EXPECT_GT(rms_distance(other.apply(a), b, weights), least);
    }
}

TEST(Transform, InverseUndoesAndApplyIsTheProduct) {
  const Similarity b_from_a = some_similarity(0.7);
  const Points a = random_cloud(5, 6), b = b_from_a.apply(a);
  EXPECT_LT((b_from_a.inverse().apply(b) - a).norm(), 1e-12);
  EXPECT_LT((b_from_a * Vec3(a.row(2)) - Vec3(b.row(2))).norm(), 1e-15);
}

TEST(Transform, WeightsOfZeroLeavePointsOut) {
  const Points a = random_cloud(6, 7);
  Points b = some_similarity(1).apply(a);
  b.row(5) += Eigen::RowVector3d(1, 1, 1);
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(6);
  weights(5) = 0;
  EXPECT_LT((fit_rigid(a, b, weights).linear() - some_similarity(1).rotation).norm(), 1e-12);
  weights(0) = -1;
  EXPECT_THROW(fit_rigid(a, b, weights), std::invalid_argument);
  EXPECT_THROW(fit_rigid(a.topRows(2), b.topRows(2)), std::invalid_argument);
}

TEST(Transform, SpreadTellsLinesFromAreas) {
  Points line(5, 3);
  for (int i = 0; i < 5; ++i) line.row(i) = i * Eigen::RowVector3d(1, 2, 3);
  EXPECT_LT(spread_off_line(line), 1e-12);
  Points square(4, 3);
  square << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  EXPECT_NEAR(spread_off_line(square), 1, 1e-12);
  EXPECT_EQ(spread_off_line(square.topRows(2)), 0);
}

}  // namespace
}  // namespace hyperex
