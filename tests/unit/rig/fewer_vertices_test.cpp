// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/fewer_vertices.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "support/sheet_mesh.hpp"

namespace hyperex::rig {
namespace {

/// 100 x 100 mm, 1 mm apart, curved; vertex colours rise with x, a texture lies over it with a seam
/// at x = 50 mm.
io::Scan curved_sheet(bool textured) {
  io::Scan scan;
  scan.mesh = test::sheet_mesh({100, 100}, {0.1, 0.1}, [](double x, double y) {
                return 0.01 * std::sin(20 * x) * std::cos(20 * y);
              }).mesh;
  const Eigen::Index n = scan.mesh.points.rows();
  if (!textured) {
    scan.vertex_colour.resize(n, 4);
    for (Eigen::Index v = 0; v < n; ++v)
      scan.vertex_colour.row(v) << std::uint8_t(std::lround(2000 * scan.mesh.points(v, 0))), 0, 0,
          255;
    return scan;
  }
  scan.texture.emplace();
  scan.corner_uv.resize(3 * scan.mesh.triangles.rows(), 2);
  for (Eigen::Index f = 0; f < scan.mesh.triangles.rows(); ++f) {
    double middle = 0;
    for (int k = 0; k < 3; ++k) middle += scan.mesh.points(scan.mesh.triangles(f, k), 0) / 3;
    for (int k = 0; k < 3; ++k) {
      const auto at = scan.mesh.points.row(scan.mesh.triangles(f, k));
      scan.corner_uv.row(3 * f + k) << float(4 * at[0] + (middle > 0.05 ? 0.5 : 0)),
          float(10 * at[1]);
    }
  }
  return scan;
}

TEST(FewerVertices, AreAsManyAsWantedAndNearTheScan) {
  const io::Scan scan = curved_sheet(false);
  const ThinnedScan thinned = with_fewer_vertices(scan, 2500);
  EXPECT_LE(thinned.scan.mesh.points.rows(), 2500);
  EXPECT_GT(thinned.scan.mesh.points.rows(), 1500);
  EXPECT_GT(thinned.off_m, 0);
  EXPECT_LT(thinned.off_m, 5e-4);
  for (Eigen::Index v = 0; v < thinned.scan.mesh.points.rows(); ++v)
    EXPECT_EQ(thinned.scan.vertex_colour(v, 0), std::lround(2000 * thinned.scan.mesh.points(v, 0)));
}

TEST(FewerVertices, KeepTheTextureOnBothSidesOfASeam) {
  const ThinnedScan thinned = with_fewer_vertices(curved_sheet(true), 3000);
  const TriMesh& mesh = thinned.scan.mesh;
  EXPECT_LT(mesh.points.rows(), 4000);
  ASSERT_EQ(thinned.scan.corner_uv.rows(), 3 * mesh.triangles.rows());
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    double middle = 0;
    for (int k = 0; k < 3; ++k) middle += mesh.points(mesh.triangles(f, k), 0) / 3;
    for (int k = 0; k < 3; ++k) {
      const auto at = mesh.points.row(mesh.triangles(f, k));
      EXPECT_NEAR(thinned.scan.corner_uv(3 * f + k, 0), 4 * at[0] + (middle > 0.05 ? 0.5 : 0),
                  1e-5);
      EXPECT_NEAR(thinned.scan.corner_uv(3 * f + k, 1), 10 * at[1], 1e-5);
    }
  }
}

TEST(FewerVertices, AreNoneWhereTheScanHasNoMore) {
  const io::Scan scan = curved_sheet(false);
  const ThinnedScan same = with_fewer_vertices(scan, 20000);
  EXPECT_EQ(same.scan.mesh.points, scan.mesh.points);
  EXPECT_EQ(same.off_m, 0);
}

}  // namespace
}  // namespace hyperex::rig
