// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/frame_products.hpp"

#include <gtest/gtest.h>

namespace hyperex::report {
namespace {

using Eigen::Index;

/// Frames of `rank` shapes, mixed.
std::vector<PointsF> mixed(Index vertices, int frames, int rank) {
  std::srand(7);
  std::vector<PointsF> shapes;
  for (int k = 0; k < rank; ++k) shapes.push_back(PointsF::Random(vertices, 3));
  std::vector<PointsF> all;
  for (int f = 0; f < frames; ++f) {
    PointsF& frame = all.emplace_back(PointsF::Zero(vertices, 3));
    for (int k = 0; k < rank; ++k)
      frame += float(std::sin(1.0 + f * (k + 1))) * shapes[std::size_t(k)];
  }
  return all;
}

Eigen::MatrixXd one_by_one(const std::vector<PointsF>& frames) {
  const auto n = Index(frames.size());
  Eigen::MatrixXd products(n, n);
  for (Index i = 0; i < n; ++i)
    for (Index j = 0; j < n; ++j)
      products(i, j) = frames[std::size_t(i)]
                           .cast<double>()
                           .cwiseProduct(frames[std::size_t(j)].cast<double>())
                           .sum();
  return products;
}

TEST(FrameProducts, AreThoseOfTheFramesAcrossBlocksOfVertices) {
  const auto frames = mixed(5000, 9, 4);
  const Eigen::MatrixXd expected = one_by_one(frames), products = frame_products(frames);
  const auto lower = [](const Eigen::MatrixXd& m) {
    return Eigen::MatrixXd(m.triangularView<Eigen::Lower>());
  };
  EXPECT_LE((lower(products) - lower(expected)).cwiseAbs().maxCoeff(),
            1e-13 * expected.cwiseAbs().maxCoeff());
}

void expect_lengths_and_angles(const std::vector<PointsF>& frames, Index most_columns) {
  const Eigen::MatrixXd c = frame_coordinates(frames, 0), expected = one_by_one(frames);
  ASSERT_EQ(c.rows(), Index(frames.size()));
  EXPECT_LE(c.cols(), most_columns);
  EXPECT_LE((c * c.transpose() - expected).cwiseAbs().maxCoeff(),
            1e-12 * expected.cwiseAbs().maxCoeff());
}

TEST(FrameCoordinates, HaveTheLengthsAndAnglesOfTheFramesInFewColumns) {
  // Single precision leaves traces of about 1e-7, so 1e-14 in squares, of further directions.
  expect_lengths_and_angles(mixed(500, 30, 3), 30);
  EXPECT_LT(frame_coordinates(mixed(500, 30, 3), 0).cols(), 30);
}

TEST(FrameCoordinates, ServeWhereThereAreMoreFramesThanCoordinates) {
  expect_lengths_and_angles(mixed(4, 40, 3), 12);
}

TEST(FrameCoordinates, OfManyFramesLieAlongTheFewShapesThatSpanThem) {
  const auto frames = mixed(300, 600, 3);
  const Eigen::MatrixXd c = frame_coordinates(frames, 1e-4), expected = one_by_one(frames);
  EXPECT_LE(c.cols(), 4);
  EXPECT_LE((c * c.transpose() - expected).cwiseAbs().maxCoeff(),
            1e-3 * expected.cwiseAbs().maxCoeff());
}

TEST(FrameCoordinates, OfStillFramesHaveNoColumns) {
  EXPECT_EQ(frame_coordinates(std::vector<PointsF>(5, PointsF::Zero(20, 3)), 0).cols(), 0);
}

}  // namespace
}  // namespace hyperex::report
