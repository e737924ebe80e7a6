// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/geodesic.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
using Cost = std::function<double(int, int)>;

test::Sheet rough_sheet() {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> unit(0, 1);
  return test::sheet_mesh({9, 7}, {9, 7}, [&](double, double) { return unit(generator); });
}

/// The algorithm of Bellman and Ford: every edge is relaxed until nothing changes.
std::vector<double> brute_force(const TriMesh& mesh, const std::vector<int>& seeds,
                                const Cost& cost) {
  std::vector<double> sum(mesh.points.rows(), infinite);
  for (int seed : seeds) sum[seed] = 0;
  for (bool changed = true; changed;) {
    changed = false;
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
      for (int k = 0; k < 3; ++k)
        for (int step = 1; step < 3; ++step) {
          const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + step) % 3);
          if (sum[a] + cost(a, b) < sum[b]) {
            sum[b] = sum[a] + cost(a, b);
            changed = true;
          }
        }
  }
  return sum;
}

TEST(EdgePaths, DistancesOnAFlatGridInClosedForm) {
  const test::Sheet sheet = test::sheet_mesh({8, 6}, {8, 6});
  const int i0 = 3, j0 = 2;
  const auto found = EdgePaths(sheet.mesh).distances({sheet.vertex(i0, j0)});
  for (int j = 0; j <= 6; ++j)
    for (int i = 0; i <= 8; ++i) {
      const int di = i - i0, dj = j - j0;  // diagonals run up to the right only
      const double diagonal = di * dj > 0 ? std::min(std::abs(di), std::abs(dj)) : 0;
      const double expected =
          std::abs(di) + std::abs(dj) - 2 * diagonal + std::sqrt(2.0) * diagonal;
      EXPECT_NEAR(found[sheet.vertex(i, j)], expected, 1e-12) << i << ' ' << j;
    }
}

TEST(EdgePaths, DistancesAgreeWithBruteForce) {
  const TriMesh mesh = rough_sheet().mesh;
  const auto length = [&](int a, int b) {
    return (mesh.points.row(a) - mesh.points.row(b)).norm();
  };
  const EdgePaths paths(mesh);
  for (const std::vector<int>& seeds : {std::vector<int>{0}, {44}, {3, 60, 71}}) {
    const auto expected = brute_force(mesh, seeds, length);
    const auto found = paths.distances(seeds), near = paths.distances(seeds, 4);
    for (std::size_t v = 0; v < expected.size(); ++v) {
      EXPECT_NEAR(found[v], expected[v], 1e-12);
      if (expected[v] <= 4)
        EXPECT_EQ(near[v], found[v]);
      else
        EXPECT_EQ(near[v], infinite);
    }
  }
}

TEST(EdgePaths, GoesRoundASlitAndNotThroughTheAir) {
  test::Sheet sheet = test::sheet_mesh({4, 2}, {4, 2});
  TriMesh& mesh = sheet.mesh;  // open the middle row from its left end to (3, 1)
  const Eigen::Index n = mesh.points.rows();
  mesh.points.conservativeResize(n + 3, 3);
  for (int i = 0; i < 3; ++i) {
    mesh.points.row(n + i) = mesh.points.row(sheet.vertex(i, 1));
    for (Eigen::Index f = 8; f < 16; ++f)  // the upper row's triangles
      for (int k = 0; k < 3; ++k)
        if (mesh.triangles(f, k) == sheet.vertex(i, 1))
          mesh.triangles(f, k) = static_cast<int>(n) + i;
  }
  const auto found = EdgePaths(mesh).distances({sheet.vertex(0, 1)});
  EXPECT_DOUBLE_EQ(found[n], 6) << "three along the slit and three back";
}

TEST(EdgePaths, UnreachedIsInfinite) {
  TriMesh mesh{Points(6, 3), Triangles(2, 3)};
  mesh.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 5, 0, 0, 6, 0, 0, 5, 1, 0;
  mesh.triangles << 0, 1, 2, 3, 4, 5;
  const EdgePaths paths(mesh);
  EXPECT_EQ(paths.distances({0})[3], infinite);
  EXPECT_TRUE(paths.cheapest(0, 4, [](int, int) { return 1.0; }).empty());
}

TEST(EdgePaths, CheapestWalkCostsWhatBruteForceFinds) {
  const TriMesh mesh = rough_sheet().mesh;
  const Cost cost = [](int a, int b) {  // differs by direction
    return 1 + std::fmod(0.37 * a * a + 0.91 * b, 1.0);
  };
  const EdgePaths paths(mesh);
  const auto around = brute_force(mesh, {5}, cost);
  for (int to : {0, 12, 33, 79}) {
    const std::vector<int> walk = paths.cheapest(5, to, cost);
    ASSERT_FALSE(walk.empty());
    EXPECT_EQ(walk.front(), 5);
    EXPECT_EQ(walk.back(), to);
    double sum = 0;
    for (std::size_t i = 0; i + 1 < walk.size(); ++i) {
      sum += cost(walk[i], walk[i + 1]);
      const auto joined = [&] {
        for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
          const auto row = mesh.triangles.row(f);
          if ((row.array() == walk[i]).any() && (row.array() == walk[i + 1]).any()) return true;
        }
        return false;
      };
      EXPECT_TRUE(joined());
    }
    EXPECT_NEAR(sum, around[to], 1e-12);
  }
  EXPECT_THAT(paths.cheapest(7, 7, cost), testing::ElementsAre(7));
}

TEST(NearestVertex, LowestIndexOnTies) {
  Points points(4, 3);
  points << 5, 0, 0, 1, 0, 0, -1, 0, 0, 1, 0, 0;
  EXPECT_EQ(nearest_vertex(points, {0, 0, 0}), 1);
  EXPECT_EQ(nearest_vertex(points, {-2, 0, 0}), 2);
}

}  // namespace
}  // namespace hyperex
