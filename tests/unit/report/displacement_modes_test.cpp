// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/displacement_modes.hpp"

#include <gtest/gtest.h>

#include <random>

namespace hyperex::report {
namespace {

/// `shapes` random shapes mixed over the frames, of falling size, and noise.
std::vector<PointsF> random_motion(int vertices, int frames, int shapes, float noise_m) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  const auto draw = [&](float size) {
    PointsF p(vertices, 3);
    for (Eigen::Index i = 0; i < p.size(); ++i) p.data()[i] = size * normal(random);
    return p;
  };
  std::vector<PointsF> shape;
  for (int k = 0; k < shapes; ++k) shape.push_back(draw(0.01f / float(1 << k)));
  std::vector<PointsF> out;
  for (int f = 0; f < frames; ++f) {
    PointsF sum = draw(noise_m);
    for (const auto& s : shape) sum += normal(random) * s;
    out.push_back(sum);
  }
  return out;
}

Eigen::MatrixXd as_matrix(const std::vector<PointsF>& frames) {
  Eigen::MatrixXd x(frames[0].size(), static_cast<Eigen::Index>(frames.size()));
  for (std::size_t f = 0; f < frames.size(); ++f)
    x.col(f) = Eigen::Map<const Eigen::VectorXf>(frames[f].data(), frames[f].size()).cast<double>();
  return x;
}

double largest_vertex_error(const Eigen::MatrixXd& difference) {
  double largest = 0;
  for (Eigen::Index f = 0; f < difference.cols(); ++f)
    for (Eigen::Index v = 0; v < difference.rows() / 3; ++v)
      largest = std::max(largest, difference.col(f).segment<3>(3 * v).norm());
  return largest;
}

double largest_vertex_error(const DisplacementModes& modes, const std::vector<PointsF>& frames) {
  double largest = 0;
  for (std::size_t f = 0; f < frames.size(); ++f)
    largest =
        std::max<double>(largest, (modes.displacement(f) - frames[f]).rowwise().norm().maxCoeff());
  return largest;
}

void expect_as_the_full_svd(const std::vector<PointsF>& frames) {
  const Eigen::MatrixXd x = as_matrix(frames);
  const Eigen::BDCSVD<Eigen::MatrixXd> svd(x, Eigen::ComputeThinU | Eigen::ComputeThinV);
  for (const double tolerance : {3e-3, 3e-4, 1e-4}) {
    Eigen::Index least = 0;
    double error = largest_vertex_error(x);
    while (error > tolerance) {
      ++least;
      const Eigen::MatrixXd rebuilt = svd.matrixU().leftCols(least) *
                                      svd.singularValues().head(least).asDiagonal() *
                                      svd.matrixV().leftCols(least).transpose();
      error = largest_vertex_error(x - rebuilt);
    }
    const auto modes = displacement_modes(frames, tolerance);
    EXPECT_EQ(static_cast<Eigen::Index>(modes.modes.size()), least) << tolerance;
    EXPECT_NEAR(modes.max_error_m, error, 1e-7) << tolerance;
    EXPECT_NEAR(largest_vertex_error(modes, frames), modes.max_error_m, 2e-8);
    EXPECT_LE(modes.max_error_m, tolerance);
  }
}

TEST(DisplacementModes, AgreeWithTheFullSvdOnNumberAndError) {
  expect_as_the_full_svd(random_motion(300, 24, 8, 1e-5f));
}

TEST(DisplacementModes, AgreeWithItWhereThereAreMoreFramesThanCoordinates) {
  expect_as_the_full_svd(random_motion(8, 60, 8, 1e-5f));
}

/// Where neither Gram matrix is small: through shapes that span the frames, found part by part.
TEST(DisplacementModes, AgreeWithItForManyFramesOfManyVertices) {
  auto frames = random_motion(230, 600, 8, 3e-7f);
  // A shape that only late frames have.
  for (std::size_t f = 550; f < frames.size(); ++f)
    frames[f].topRows(40).array() += 0.002f * float(f % 7);
  expect_as_the_full_svd(frames);
}

TEST(DisplacementModes, HoldTheToleranceAcrossBlocksOfVertices) {
  // More vertices than are taken at a time, the last ones moving in their own way.
  auto frames = random_motion(5000, 12, 3, 0);
  for (std::size_t f = 0; f < frames.size(); ++f)
    frames[f].bottomRows(1).setConstant(0.004f * std::sin(2.1f * float(f)));
  const auto modes = displacement_modes(frames, 2e-5);
  EXPECT_EQ(modes.modes.size(), 4u);
  EXPECT_LE(largest_vertex_error(modes, frames), 2e-5);
}

TEST(DisplacementModes, WeightsPeakAtPlusOne) {
  const auto modes = displacement_modes(random_motion(100, 9, 4, 0), 1e-5);
  ASSERT_GT(modes.modes.size(), 0u);
  for (Eigen::Index k = 0; k < modes.weights.cols(); ++k) {
    EXPECT_NEAR(modes.weights.col(k).maxCoeff(), 1, 1e-6);
    EXPECT_GE(modes.weights.col(k).minCoeff(), -1 - 1e-6);
  }
}

TEST(DisplacementModes, ToleranceZeroGivesAllFramesBack) {
  const auto frames = random_motion(50, 6, 6, 1e-3f);
  const auto modes = displacement_modes(frames, 0);
  EXPECT_EQ(modes.modes.size(), 6u);
  EXPECT_LT(largest_vertex_error(modes, frames), 1e-7);
}

TEST(DisplacementModes, StillnessAndNothingHaveNoModes) {
  const auto still = displacement_modes(std::vector<PointsF>(5, PointsF::Zero(20, 3)));
  EXPECT_TRUE(still.modes.empty());
  EXPECT_EQ(still.weights.rows(), 5);
  EXPECT_EQ(still.max_error_m, 0);
  EXPECT_TRUE(displacement_modes({}).modes.empty());
  // A long take that moves as the one that it is compared with.
  EXPECT_TRUE(displacement_modes(std::vector<PointsF>(600, PointsF::Zero(300, 3))).modes.empty());
}

}  // namespace
}  // namespace hyperex::report
