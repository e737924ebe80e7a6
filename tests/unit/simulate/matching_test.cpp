// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/matching.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace hyperex::simulate {
namespace {

double to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const double t = std::clamp((p - a).dot(b - a) / (b - a).squaredNorm(), 0.0, 1.0);
  return (p - a - t * (b - a)).norm();
}

/// Distance to the plane where the foot of the perpendicular is inside the triangle, else to the
/// nearest edge.
double to_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 n = (b - a).cross(c - a);
  if (n.dot((b - a).cross(p - a)) >= 0 && n.dot((c - b).cross(p - b)) >= 0 &&
      n.dot((a - c).cross(p - c)) >= 0)
    return std::abs((p - a).dot(n.normalized()));
  return std::min({to_segment(p, a, b), to_segment(p, b, c), to_segment(p, c, a)});
}

double brute_force(const Vec3& p, const TriMesh& mesh) {
  double best = 1e300;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    best = std::min(best, to_triangle(p, mesh.points.row(mesh.triangles(f, 0)),
                                      mesh.points.row(mesh.triangles(f, 1)),
                                      mesh.points.row(mesh.triangles(f, 2))));
  return best;
}

Points random_points(int count, double extent, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> unit(-extent, extent);
  Points points(count, 3);
  for (Eigen::Index i = 0; i < count; ++i)
    points.row(i) << unit(generator), unit(generator), unit(generator);
  return points;
}

TriMesh loose_triangles(bool obtuse) {
  const int count = 150;
  TriMesh mesh{random_points(3 * count, 0.1, 7), Triangles(count, 3)};
  for (int f = 0; f < count; ++f) {
    mesh.triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
    if (!obtuse) continue;  // the third corner just off the first edge: two weights go negative
    const Eigen::RowVector3d a = mesh.points.row(3 * f), b = mesh.points.row(3 * f + 1);
    mesh.points.row(3 * f + 2) = 0.6 * a + 0.4 * b + 0.05 * mesh.points.row(3 * f + 2);
  }
  return mesh;
}

class OnTriangles : public testing::TestWithParam<bool> {};

TEST_P(OnTriangles, AgreesWithBruteForce) {
  const TriMesh mesh = loose_triangles(GetParam());
  const Points places = random_points(800, 0.15, 11);
  const auto matches = match(places, mesh);
  ASSERT_EQ(matches.size(), 800u);
  int corners = 0, edges = 0, faces = 0;
  for (Eigen::Index i = 0; i < places.rows(); ++i) {
    const Match& m = matches[i];
    EXPECT_NEAR(m.distance_m, brute_force(places.row(i), mesh), 1e-14);
    EXPECT_NEAR(m.weight.sum(), 1, 1e-14);
    EXPECT_GE(m.weight.minCoeff(), 0);
    const Vec3 closest = m.displacement(mesh.points);  // the same weights, of positions
    EXPECT_NEAR((closest - places.row(i).transpose()).norm(), m.distance_m, 1e-14);
    const auto zeros = (m.weight.array() == 0).count();
    ++(zeros == 2 ? corners : zeros == 1 ? edges : faces);
  }
  EXPECT_GT(std::min({corners, edges, faces}), 10) << "all three regions are met";
}

INSTANTIATE_TEST_SUITE_P(RandomAndObtuse, OnTriangles, testing::Bool());

TEST(Match, DisplacementIsTheWeightedMean) {
  TriMesh mesh{Points(3, 3), Triangles(1, 3)};
  mesh.points << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  mesh.triangles << 0, 1, 2;
  Points place(1, 3);
  place << 0.2, 0.3, 0.7;
  const Match m = match(place, mesh)[0];
  EXPECT_NEAR(m.distance_m, 0.7, 1e-15);
  Points d(3, 3);
  d << 1, 0, 0, 0, 1, 0, 0, 0, 1;
  EXPECT_LT((m.displacement(d) - Vec3(0.5, 0.2, 0.3)).norm(), 1e-15);
}

/// Two strips of triangles along the x axis, `gap` apart; the points of the lower one come first.
TriMesh lips(double gap) {
  TriMesh mesh{Points(20, 3), Triangles(16, 3)};
  for (int side = 0; side < 2; ++side)
    for (int i = 0; i < 5; ++i)
      for (int row = 0; row < 2; ++row)
        mesh.points.row(10 * side + 2 * i + row) << 0.01 * i,
            side ? gap / 2 + 0.01 * row : -gap / 2 - 0.01 * row, 0;
  for (int side = 0, f = 0; side < 2; ++side)
    for (int i = 0; i < 4; ++i) {
      const int a = 10 * side + 2 * i;
      mesh.triangles.row(f++) << a, a + 1, a + 2;
      mesh.triangles.row(f++) << a + 1, a + 3, a + 2;
    }
  return mesh;
}

TEST(Match, LipsNeverCross) {
  const TriMesh tracked = lips(0.0005);
  std::vector<int> point_side(20, 1);
  std::fill_n(point_side.begin(), 10, -1);
  Points places = random_points(300, 0.006, 13);
  places.col(0).array() += 0.02;
  std::vector<int> side(300);
  for (int i = 0; i < 300; ++i) side[i] = i % 3 - 1;
  const auto matches = match(places, tracked, side, point_side);
  TriMesh part[2] = {tracked, tracked};
  part[0].triangles = tracked.triangles.topRows(8);
  part[1].triangles = tracked.triangles.bottomRows(8);
  int drawn_away = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 p = places.row(i);
    const double whole = brute_force(p, tracked);
    const double own = side[i] == 0 ? whole : brute_force(p, part[side[i] > 0]);
    EXPECT_NEAR(matches[i].distance_m, own, 1e-14);
    drawn_away += own > whole;
    for (int k = 0; k < 3 && side[i] != 0; ++k)
      EXPECT_EQ(point_side[matches[i].point[k]], side[i]) << "not even with weight 0";
  }
  EXPECT_GT(drawn_away, 50) << "the nearest would have been the other lip";
}

TEST(Match, FollowsTheOtherLipOnlyWhereThereIsNothingElse) {
  TriMesh tracked = lips(0.0005);
  tracked.triangles = Triangles(tracked.triangles.topRows(8));
  std::vector<int> point_side(20, 1);
  std::fill_n(point_side.begin(), 10, -1);
  Points place(1, 3);
  place << 0.02, 0.004, 0;
  EXPECT_NEAR(match(place, tracked, {1}, point_side)[0].distance_m, 0.00425, 1e-14);
}

}  // namespace
}  // namespace hyperex::simulate
