// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/sky_share.hpp"

#include <gtest/gtest.h>

namespace hyperex::render {
namespace {

/// A square of `half_m` in the plane z = 0, normal +z, or the wall x = 0, normal +x.
TriMesh flat_square(double half_m, bool wall) {
  TriMesh mesh;
  mesh.points.resize(4, 3);
  for (int i = 0; i < 4; ++i) {
    const double a = half_m * (i == 1 || i == 2 ? 1 : -1), b = half_m * (i >= 2 ? 1 : -1);
    if (wall)
      mesh.points.row(i) << 0, a, b;
    else
      mesh.points.row(i) << a, b, 0;
  }
  mesh.triangles.resize(2, 3);
  mesh.triangles << 0, 1, 2, 0, 2, 3;
  return mesh;
}

float at(const TriMesh& mesh, const Vec3& place, double far_m) {
  return sky_share(mesh, place.transpose(), Vec3::UnitZ().transpose(), far_m)[0];
}

TEST(SkyShare, IsOneOnAPlaneAndHalfInACorner) {
  const TriMesh plane = flat_square(1, false);
  EXPECT_EQ(sky_share(plane).minCoeff(), 1);
  // At its foot a wall blocks one half of the light from all sides, weighted by the cosine.
  EXPECT_NEAR(at(flat_square(10, true), {1e-3, 0, 0}, 100), 0.5, 0.05);
}

TEST(SkyShare, FollowsTheFormFactorOfAWallOfFiniteHeight) {
  // A long wall of height h at distance d takes (1 - d / sqrt(d^2 + h^2)) / 2 (Hottel's crossed
  // strings).
  TriMesh wall = flat_square(1, true);
  for (int i = 0; i < 4; ++i) wall.points(i, 2) = wall.points(i, 2) > 0 ? 0.03 : 0;
  for (const double d : {0.01, 0.02, 0.04}) {
    const double taken = (1 - d / std::hypot(d, 0.03)) / 2;
    EXPECT_NEAR(at(wall, {d, 0, 0}, 10), 1 - taken, 0.03) << d;
  }
}

TEST(SkyShare, CountsNothingBeyondItsReachAndNothingWithoutANormal) {
  const TriMesh wall = flat_square(10, true);
  EXPECT_EQ(at(wall, {0.06, 0, 0}, 0.05), 1);
  EXPECT_LT(at(wall, {0.04, 0, 0}, 0.05), 1);
  EXPECT_EQ(sky_share(wall, Vec3(1e-3, 0, 0).transpose(), Vec3::Zero().transpose(), 100)[0], 1);
  EXPECT_EQ(sky_share(TriMesh{}, Vec3::Zero().transpose(), Vec3::UnitZ().transpose())[0], 1);
}

}  // namespace
}  // namespace hyperex::render
