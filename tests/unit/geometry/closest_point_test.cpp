// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/closest_point.hpp"

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>
#include <tbb/task.h>

#include <algorithm>
#include <limits>
#include <random>

namespace hyperex {
namespace {

enum class Shape { random, obtuse, sliver, degenerate };

// Separate triangles of one kind in the unit cube.
TriMesh triangles_of(Shape shape, int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(-1, 1);
  const auto any = [&] { return Vec3(unit(generator), unit(generator), unit(generator)); };
  TriMesh mesh{Points(3 * count, 3), Triangles(count, 3)};
  for (int f = 0; f < count; ++f) {
    const Vec3 a = any(), along = 0.3 * any();
    Vec3 b = a + along, c = a + 0.3 * any();
    if (shape == Shape::obtuse) c = a - 0.4 * along + 0.05 * any();
    if (shape == Shape::sliver) c = a + 0.6 * along + 1e-9 * any();
    if (shape == Shape::degenerate) c = f % 2 ? Vec3(a + 0.6 * along) : a;
    if (shape == Shape::degenerate && f % 4 == 0) b = a;
    mesh.points.row(3 * f) = a.transpose();
    mesh.points.row(3 * f + 1) = b.transpose();
    mesh.points.row(3 * f + 2) = c.transpose();
    mesh.triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  return mesh;
}

// q is the nearest point of a convex set if and only if (p - q).(v - q) <= 0 for all its corners v.
// Returns the largest violation.
double optimality_gap(const Vec3& p, const Vec3& q, const Vec3& a, const Vec3& b, const Vec3& c) {
  return std::max({(p - q).dot(a - q), (p - q).dot(b - q), (p - q).dot(c - q)});
}

class OnShapes : public testing::TestWithParam<Shape> {};

TEST_P(OnShapes, TriangleAnswerIsOptimal) {
  const TriMesh mesh = triangles_of(GetParam(), 2000, 1);
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int f = 0; f < 2000; ++f) {
    const Vec3 a = mesh.points.row(3 * f), b = mesh.points.row(3 * f + 1);
    const Vec3 c = mesh.points.row(3 * f + 2);
    const Vec3 p = a + 0.4 * Vec3(unit(generator), unit(generator), unit(generator));
    const ClosestPoint found = closest_point_on_triangle(p, a, b, c);
    EXPECT_GE(found.weights.minCoeff(), 0);
    EXPECT_NEAR(found.weights.sum(), 1, 1e-14);
    const Vec3 q = found.weights[0] * a + found.weights[1] * b + found.weights[2] * c;
    EXPECT_LT((q - found.point).norm(), 1e-14);
    EXPECT_NEAR(found.squared_distance, (p - q).squaredNorm(), 1e-14);
    EXPECT_LT(optimality_gap(p, q, a, b, c), 2e-9);  // the slivers are 1e-9 wide
  }
}

// The result has the same triangle and the same bits, wherever on the surface the search starts.
TEST_P(OnShapes, AnAnswerFoundFromNearbyIsTheSame) {
  const TriMesh mesh = triangles_of(GetParam(), 400, 5);
  const SurfaceTree tree(mesh);
  Points queries = 1.5 * Points::Random(500, 3);
  queries.topRows(100) = mesh.points.topRows(100);  // upon it: distance 0
  const auto plain = tree.query_all(queries);
  auto near = plain;
  for (int shift : {0, 1, 250}) {
    std::rotate(near.begin(), near.begin() + shift, near.end());
    const auto found = tree.query_all(queries, near);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      EXPECT_EQ(found[i].triangle, plain[i].triangle);
      EXPECT_EQ(found[i].squared_distance, plain[i].squared_distance);
      EXPECT_EQ(found[i].weights, plain[i].weights);
    }
  }
}

TEST_P(OnShapes, AmongSomeTrianglesTheAnswerIsThatOfATreeOfThoseAlone) {
  const TriMesh mesh = triangles_of(GetParam(), 400, 6);
  const SurfaceTree tree(mesh);
  std::vector<char> keep(400, 0);
  TriMesh part{mesh.points, Triangles(200, 3)};
  for (int f = 0; f < 200; ++f) {
    keep[std::size_t(2 * f)] = 1;
    part.triangles.row(f) = mesh.triangles.row(2 * f);
  }
  const SurfaceTree alone(part);
  const Points queries = 1.5 * Points::Random(300, 3);
  for (const auto p : queries.rowwise()) {
    const ClosestPoint expected = alone.query(p.transpose());
    const ClosestPoint found = tree.query_among(keep, p.transpose());
    EXPECT_EQ(found.triangle, 2 * expected.triangle);
    EXPECT_EQ(found.squared_distance, expected.squared_distance);
  }
  keep.pop_back();
  EXPECT_THROW(tree.query_among(keep, Vec3::Zero()), std::invalid_argument);
}

TEST_P(OnShapes, TreeAgreesWithBruteForce) {
  const TriMesh mesh = triangles_of(GetParam(), 400, 3);
  const SurfaceTree tree(mesh);
  const Points queries = 1.5 * Points::Random(500, 3);
  const auto found = tree.query_all(queries);
  for (int i = 0; i < queries.rows(); ++i) {
    const Vec3 p = queries.row(i);
    double least = std::numeric_limits<double>::infinity();
    int nearest = -1;
    for (int f = 0; f < mesh.triangles.rows(); ++f) {
      const ClosestPoint one = closest_point_on_triangle(
          p, mesh.points.row(3 * f), mesh.points.row(3 * f + 1), mesh.points.row(3 * f + 2));
      if (one.squared_distance < least) {
        least = one.squared_distance;
        nearest = f;
      }
    }
    EXPECT_EQ(found[i].squared_distance, least);
    EXPECT_EQ(found[i].triangle, nearest);
    EXPECT_EQ(tree.query(p).triangle, nearest);
  }
}

INSTANTIATE_TEST_SUITE_P(ClosestPoint, OnShapes,
                         testing::Values(Shape::random, Shape::obtuse, Shape::sliver,
                                         Shape::degenerate));

TEST(ClosestPoint, WithinADistanceOnly) {
  TriMesh mesh;
  mesh.points.resize(3, 3);
  mesh.points << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.triangles.resize(1, 3);
  mesh.triangles << 0, 1, 2;
  const SurfaceTree tree(mesh);
  EXPECT_EQ(tree.query({0.2, 0.2, 0.5}, 0.49).triangle, -1);
  EXPECT_EQ(tree.query({0.2, 0.2, 0.5}, 0.5).triangle, 0);
  EXPECT_EQ(tree.query({0.2, 0.2, 0.5}, 0.51).squared_distance, 0.25);
}

TEST(ClosestPoint, BeyondTheObtuseCornerTheEdgeIsNearest) {
  // Both weights of b and c are negative at p, yet the nearest point lies inside edge ab: the case
  // in which signs of weights mislead.
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(-2, 0.5, 0), p(0.2, -1, 0);
  const ClosestPoint found = closest_point_on_triangle(p, a, b, c);
  EXPECT_NEAR((found.point - Vec3(0.2, 0, 0)).norm(), 0, 1e-15);
}

TEST(ClosestPoint, TiesGoToTheLowestIndex) {
  // A fan about one vertex, seen from above it, and the same triangles in the opposite order.
  TriMesh mesh{Points(9, 3), Triangles(8, 3)};
  mesh.points.row(0) << 0, 0, 0;
  for (int k = 0; k < 8; ++k) {
    const double angle = k * M_PI / 4;
    mesh.points.row(1 + k) << std::cos(angle), std::sin(angle), -1;
  }
  for (int k = 0; k < 8; ++k) mesh.triangles.row(k) << 0, 1 + k, 1 + (k + 1) % 8;
  EXPECT_EQ(SurfaceTree(mesh).query(Vec3(0, 0, 1)).triangle, 0);
  mesh.triangles = mesh.triangles.colwise().reverse().eval();
  EXPECT_EQ(SurfaceTree(mesh).query(Vec3(0, 0, 1)).triangle, 0);
}

TEST(ClosestPoint, KeepsItsDigitsFarFromTheOrigin) {
  TriMesh mesh = triangles_of(Shape::random, 200, 5);
  const SurfaceTree near(mesh);
  const Vec3 shift(1e4, -2e4, 3e4);
  mesh.points.rowwise() += shift.transpose();
  const SurfaceTree far(mesh);
  const Points queries = Points::Random(200, 3);
  for (int i = 0; i < queries.rows(); ++i) {
    const Vec3 p = queries.row(i);
    EXPECT_NEAR(near.query(p).squared_distance, far.query(p + shift).squared_distance, 1e-10);
  }
}

TEST(ClosestPoint, RefusesWhatIsNoMesh) {
  EXPECT_THROW(SurfaceTree(TriMesh{Points::Zero(3, 3), Triangles(0, 3)}), std::invalid_argument);
  TriMesh mesh = triangles_of(Shape::random, 1, 6);
  mesh.triangles(0, 1) = 3;
  EXPECT_THROW(SurfaceTree{mesh}, std::invalid_argument);
  mesh.triangles(0, 1) = 1;
  mesh.points(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(SurfaceTree{mesh}, std::invalid_argument);
}

/// Another task of the group has thrown. This one continues to its end and builds a complete tree.
TEST(SurfaceTree, IsBuiltWholeInACancelledGroupOfTasks) {
  const TriMesh mesh = triangles_of(Shape::random, 20000, 5);
  const Vec3 p(0.1, 0.2, 0.3);
  const ClosestPoint wanted = SurfaceTree(mesh).query(p);
  int found = -1;
  tbb::parallel_for(0, 1, [&](int) {
    tbb::task::current_context()->cancel_group_execution();
    found = SurfaceTree(mesh).query(p).triangle;
  });
  EXPECT_EQ(found, wanted.triangle);
}

}  // namespace
}  // namespace hyperex
