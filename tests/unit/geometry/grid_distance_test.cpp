// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/grid_distance.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "hyperex/geometry/mesh_distance.hpp"

namespace hyperex {
namespace {

TriMesh box(const Vec3& half, const Vec3& centre = Vec3::Zero()) {
  TriMesh mesh{Points(8, 3), Triangles(12, 3)};
  for (int c = 0; c < 8; ++c)
    mesh.points.row(c) = centre + Vec3((c & 1 ? 1 : -1) * half.x(), (c & 2 ? 1 : -1) * half.y(),
                                       (c & 4 ? 1 : -1) * half.z());
  mesh.triangles << 0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6,
      0, 6, 2, 1, 3, 7, 1, 7, 5;
  return mesh;
}

/// A ball meshed by latitudes and longitudes.
TriMesh ball(double radius, const Vec3& centre, int rings = 96, int sectors = 192) {
  TriMesh mesh{Points(2 + (rings - 1) * sectors, 3), Triangles(2 * (rings - 1) * sectors, 3)};
  mesh.points.row(0) = centre + Vec3(0, 0, radius);
  mesh.points.row(1) = centre - Vec3(0, 0, radius);
  const auto at = [&](int ring, int k) {
    if (ring == 0) return 0;
    return ring == rings ? 1 : 2 + (ring - 1) * sectors + k % sectors;
  };
  for (int ring = 1; ring < rings; ++ring)
    for (int k = 0; k < sectors; ++k) {
      const double polar = M_PI * ring / rings, turn = 2 * M_PI * k / sectors;
      mesh.points.row(at(ring, k)) =
          centre + radius * Vec3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                 std::cos(polar));
    }
  Eigen::Index row = 0;
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < sectors; ++k) {
      if (ring > 0) mesh.triangles.row(row++) << at(ring, k), at(ring + 1, k), at(ring, k + 1);
      if (ring + 1 < rings)
        mesh.triangles.row(row++) << at(ring + 1, k), at(ring + 1, k + 1), at(ring, k + 1);
    }
  return mesh;
}

double to_box(const Vec3& p, const Vec3& half) {
  const Vec3 q = p.cwiseAbs() - half;
  return q.cwiseMax(0).norm() + std::min(0.0, q.maxCoeff());
}

class Somewhere {
 public:
  Vec3 within(double size) { return size * Vec3(unit_(random_), unit_(random_), unit_(random_)); }

 private:
  std::mt19937 random_{7};
  std::uniform_real_distribution<double> unit_{-1, 1};
};

TEST(MeshDistance, IsExactInAndOutOfABox) {
  const Vec3 half(0.004, 0.003, 0.0025);
  const MeshDistance exact(box(half));
  Somewhere any;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 p = any.within(0.008);
    EXPECT_NEAR(exact.at(p), to_box(p, half), 1e-15) << p.transpose();
    EXPECT_EQ(exact.at(p, 1.5 * std::abs(to_box(p, half))), exact.at(p));
    if (!exact.may_hold(p)) {
      EXPECT_GT(exact.at(p), 0);
    }
  }
  // Before edges and corners too, where two or three triangles are as near.
  EXPECT_NEAR(exact.at({0.0045, 0.0035, 0}), std::sqrt(0.5) * 1e-3, 1e-15);
  EXPECT_NEAR(exact.at({0.0045, 0.0035, -0.003}), std::sqrt(0.75) * 1e-3, 1e-15);
}

TEST(GridDistance, MeetsABallInAndOut) {
  const Vec3 centre(0.003, -0.1, 0.02);
  const double radius = 0.004;
  const GridDistance grid(ball(radius, centre));
  const SphereDistance truth(centre, radius);
  Somewhere any;
  Vec3 outward, expected;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = centre + any.within(0.0055);
    const double exact = truth.at(p, expected);
    const double found = grid.at(p, outward);
    const double off = std::abs(exact);
    if (off < 0.001) {
      EXPECT_NEAR(found, exact, 1.2e-5) << p.transpose();
      EXPECT_LT((outward - expected).norm(), 0.03) << p.transpose();
      EXPECT_NEAR(outward.norm(), 1, 0.02);
    } else if ((p - centre).norm() > 0.002) {  // not at the middle, which is a kink
      EXPECT_NEAR(found, exact, 4e-4) << p.transpose();
    }
  }
}

TEST(GridDistance, MeetsABoxWithItsEdges) {
  const Vec3 half(0.004, 0.003, 0.0025);
  const GridDistance grid(box(half), {.cell_m = 2.5e-4});
  Somewhere any;
  Vec3 outward;
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec3 p = any.within(0.0055);
    const double exact = to_box(p, half);
    if (std::abs(exact) > 0.001) continue;
    const double found = grid.at(p, outward);
    worst = std::max(worst, std::abs(found - exact));
    if (std::abs(exact) > 1e-4) {
      EXPECT_EQ(found < 0, exact < 0) << p.transpose();
    }
  }
  // What a cell rounds off an edge.
  EXPECT_LT(worst, 0.25 * 2.5e-4);
  // By a flat face it is exact, and at the edge its sign is right.
  EXPECT_NEAR(grid.at({0.0047, 0.0001, 0.0002}, outward), 0.0007, 1e-9);
  EXPECT_LT((outward - Vec3::UnitX()).norm(), 1e-5);
  EXPECT_GT(grid.at({0.0043, 0.0033, 0}, outward), 0);
  EXPECT_LT(grid.at({0.0037, 0.0027, 0}, outward), 0);
}

TEST(GridDistance, GradientIsThatOfTheValue) {
  const GridDistance grid(box({0.004, 0.003, 0.0025}));
  Somewhere any;
  Vec3 outward, other;
  constexpr double h = 1e-7;
  for (int i = 0; i < 500; ++i) {
    const Vec3 p = any.within(0.006);
    grid.at(p, outward);
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 step = h * Vec3::Unit(axis);
      const double difference = (grid.at(p + step, other) - grid.at(p - step, other)) / (2 * h);
      EXPECT_NEAR(outward[axis], difference, 2e-3) << p.transpose();
    }
  }
}

TEST(GridDistance, GradientIsContinuousFromCellToCell) {
  const GridDistance grid(ball(0.004, Vec3::Zero(), 48, 96));
  Vec3 before, after;
  for (int i = 0; i < 3000; ++i) {
    const Vec3 p = (0.003 + 7e-7 * i) * Vec3(0.6, 0.48, 0.64);
    grid.at(p, before);
    grid.at(p * (1 + 1e-9), after);
    EXPECT_LT((after - before).norm(), 1e-5);
  }
}

TEST(GridDistance, ComponentsCountAsTheirUnion) {
  const Vec3 half(0.003, 0.003, 0.003);
  const TriMesh a = box(half), b = box(half, Vec3(0.004, 0, 0));
  TriMesh both{Points(16, 3), Triangles(24, 3)};
  both.points << a.points, b.points;
  both.triangles << a.triangles, (b.triangles.array() + 8).matrix();
  const GridDistance grid(both);
  Vec3 outward;
  // Within the second box just inside the hidden wall of the first, and where they overlap.
  EXPECT_LT(grid.at({0.0031, 0, 0}, outward), -0.001);
  EXPECT_LT(grid.at({0.0009, 0, 0}, outward), -0.001);
  EXPECT_LT(grid.at({0.002, 0, 0}, outward), -0.0005);
  EXPECT_NEAR(grid.at({0.002, 0.004, 0}, outward), 0.001, 1e-6);
  EXPECT_NEAR(grid.at({0.008, 0, 0}, outward), 0.001, 1e-6);
}

TEST(GridDistance, GoesOnBeyondTheGrid) {
  const GridDistance grid(box({0.004, 0.004, 0.004}));
  Vec3 outward;
  EXPECT_NEAR(grid.at({0.1, 0, 0}, outward), 0.096, 1e-4);
  EXPECT_LT((outward - Vec3::UnitX()).norm(), 1e-9);
}

TEST(GridDistance, RefusesWhatItCannotSample) {
  const TriMesh whole = box({0.004, 0.004, 0.004});
  TriMesh open = whole;
  open.triangles.conservativeResize(11, 3);
  EXPECT_THROW(GridDistance{open}, std::invalid_argument);
  EXPECT_THROW(GridDistance(TriMesh{}), std::invalid_argument);
  EXPECT_THROW(GridDistance(whole, {.cell_m = 0}), std::invalid_argument);
  EXPECT_THROW(GridDistance(whole, {.cell_m = 1e-6}), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex
