// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/mouth_outline.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/face/ibug.hpp"

namespace hyperex::metrics {
namespace {

/// A ring between an ellipse of 40 x 20 mm and one twice as large.
TriMesh ring(int n) {
  TriMesh mesh{Points(2 * n, 3), Triangles(2 * n, 3)};
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * M_PI * i / n;
    const Vec3 inner(0.02 * std::cos(angle), 0.01 * std::sin(angle), 0);
    mesh.points.row(i) = inner.transpose();
    mesh.points.row(n + i) = 2 * inner.transpose();
    const int next = (i + 1) % n;
    mesh.triangles.row(2 * i) << i, n + i, n + next;
    mesh.triangles.row(2 * i + 1) << i, n + next, next;
  }
  return mesh;
}

io::Landmarks inner_lips() {
  io::Landmarks landmarks;
  for (int k = 60; k <= 67; ++k) {
    const double angle = 2 * M_PI * (k - 60) / 8;
    landmarks[face::ibug(k)] = Vec3(0.02 * std::cos(angle), 0.01 * std::sin(angle), 0);
  }
  return landmarks;
}

TEST(MouthOutline, RimIsTheBorderBesideTheInnerLips) {
  const TriMesh mesh = ring(120);
  const std::vector<int> rim = mouth_rim(mesh, inner_lips());
  ASSERT_EQ(rim.size(), 120u);
  for (const int v : rim) EXPECT_LT(v, 120);
  io::Landmarks elsewhere = inner_lips();
  for (auto& [name, at] : elsewhere) at.z() += 0.02;
  EXPECT_TRUE(mouth_rim(mesh, elsewhere).empty());
}

TEST(MouthOutline, OvalTurnsOnce) {
  const TriMesh mesh = ring(120);
  const std::vector<int> rim = mouth_rim(mesh, inner_lips());
  const auto outline = mouth_outline(mesh, rim, PointsF::Zero(240, 3));
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->turning_deg, 360, 0.5);
  EXPECT_EQ(outline->largest_jump_mm, 0);
}

/// A square notch of 5 mm adds four right angles, two of them in the opposite direction, less the
/// effect of smoothing.
TEST(MouthOutline, NotchCountsAndSoDoesItsJump) {
  const TriMesh mesh = ring(240);
  const std::vector<int> rim = mouth_rim(mesh, inner_lips());
  PointsF notch = PointsF::Zero(480, 3);
  for (int v = 0; v < 240; ++v)
    if (mesh.points(v, 1) > 0 && std::abs(mesh.points(v, 0)) < 0.003) notch(v, 1) = 0.005F;
  const auto outline = mouth_outline(mesh, rim, notch);
  ASSERT_TRUE(outline);
  EXPECT_NEAR(outline->largest_jump_mm, 5, 1e-3);
  EXPECT_GT(outline->turning_deg, 360 + 180);
  EXPECT_LT(outline->turning_deg, 360 + 360);
}

TEST(MouthOutline, NoiseOfAScanHardlyCounts) {
  const TriMesh mesh = ring(120);
  const std::vector<int> rim = mouth_rim(mesh, inner_lips());
  PointsF noise = PointsF::Zero(240, 3);
  for (int v = 0; v < 120; ++v) noise(v, v % 3) = (v % 2 ? 1e-4F : -1e-4F);
  EXPECT_NEAR(mouth_outline(mesh, rim, noise)->turning_deg, 360, 15);
}

TEST(MouthOutline, NothingWithoutARim) {
  EXPECT_FALSE(mouth_outline(ring(8), {}, PointsF::Zero(16, 3)));
}

}  // namespace
}  // namespace hyperex::metrics
