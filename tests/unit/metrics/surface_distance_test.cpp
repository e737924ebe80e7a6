// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/surface_distance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

namespace hyperex::metrics {
namespace {

TEST(DistanceStatistics, OfAKnownSet) {
  Eigen::VectorXd distance(5);
  distance << 0.004, 0.001, 0.010, 0.002, 0.003;
  const DistanceStatistics s = statistics_of(distance);
  EXPECT_NEAR(s.mean_mm, 4, 1e-12);
  EXPECT_NEAR(s.median_mm, 3, 1e-12);
  EXPECT_NEAR(s.rms_mm, std::sqrt(26.0), 1e-12);
  EXPECT_NEAR(s.p95_mm, 4 + 0.8 * 6, 1e-12);
  EXPECT_NEAR(s.max_mm, 10, 1e-12);
  EXPECT_EQ(s.count, 5);
  const DistanceStatistics some = statistics_of(distance, {0, 3});
  EXPECT_NEAR(some.mean_mm, 3, 1e-12);
  EXPECT_NEAR(some.max_mm, 4, 1e-12);
  EXPECT_EQ(some.count, 2);
}

// Many values are sorted differently from few. The values range from nearly zero to large, with
// zeros and duplicates.
TEST(DistanceStatistics, OfManyAreThoseOfTheSortedValues) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> power(-300, 3);
  Eigen::VectorXd distance(5001);
  for (double& value : distance) value = std::pow(10, power(generator));
  distance.segment(100, 50).setZero();
  distance.segment(200, 50) = distance.segment(300, 50);
  for (const bool negative : {false, true}) {
    if (negative) distance[7] = -1;
    std::vector<double> sorted(distance.begin(), distance.end());
    std::sort(sorted.begin(), sorted.end());
    double sum = 0;
    for (const double value : sorted) sum += value;
    const DistanceStatistics s = statistics_of(distance);
    EXPECT_EQ(s.mean_mm, 1e3 * sum / 5001);  // to the bit: the order of the sum is that
    EXPECT_EQ(s.median_mm, 1e3 * sorted[2500]);
    EXPECT_EQ(s.p95_mm, 1e3 * sorted[4750]);
    EXPECT_EQ(s.max_mm, 1e3 * sorted.back());
  }
}

TEST(DistanceStatistics, OfNothingIsNaN) {
  const DistanceStatistics s = statistics_of(Eigen::VectorXd::Ones(3), {});
  EXPECT_TRUE(std::isnan(s.mean_mm));
  EXPECT_EQ(s.count, 0);
}

TriMesh square() {
  TriMesh mesh{Points(4, 3), Triangles(2, 3)};
  mesh.points << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0;
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

TEST(SurfaceDistance, IsToTheClosestPointNotTheClosestVertex) {
  Points points(3, 3);
  points << 0.5, 0.4, 0.2, 0.5, -0.3, 0.4, -3, -4, 0;
  const Eigen::VectorXd distance = distance_to_surface(points, square());
  EXPECT_NEAR(distance[0], 0.2, 1e-15);
  EXPECT_NEAR(distance[1], 0.5, 1e-15);
  EXPECT_NEAR(distance[2], 5, 1e-15);
}

TEST(SurfaceDistance, SlidingAlongTheSurfaceShowsOnlyByCorrespondence) {
  const TriMesh mesh = square();
  Points slid = 0.5 * mesh.points;
  EXPECT_NEAR(distance_to_surface(slid, mesh).maxCoeff(), 0, 1e-15);
  EXPECT_NEAR(distance_to_corresponding(slid, mesh.points, 4)[2], std::sqrt(0.5), 1e-15);
}

TEST(SurfaceDistance, AppendedVerticesAreLeftOut) {
  Points longer(5, 3);
  longer << square().points, 9, 9, 9;
  const Eigen::VectorXd distance = distance_to_corresponding(longer, square().points, 4);
  EXPECT_EQ(distance.size(), 4);
  EXPECT_EQ(distance.maxCoeff(), 0);
  EXPECT_THROW(distance_to_corresponding(longer, square().points, 5), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex::metrics
