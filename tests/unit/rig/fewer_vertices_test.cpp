// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/fewer_vertices.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ranges>

#include "hyperex/face/ibug.hpp"
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
  const ThinnedScan thinned = with_fewer_vertices(scan, {}, 2500);
  EXPECT_LE(thinned.scan.mesh.points.rows(), 2500);
  EXPECT_GT(thinned.scan.mesh.points.rows(), 1500);
  EXPECT_GT(thinned.off_m, 0);
  EXPECT_LT(thinned.off_m, 5e-4);
  for (Eigen::Index v = 0; v < thinned.scan.mesh.points.rows(); ++v)
    EXPECT_EQ(thinned.scan.vertex_colour(v, 0), std::lround(2000 * thinned.scan.mesh.points(v, 0)));
}

void expect_texture_of_curved_sheet(const io::Scan& scan) {
  const TriMesh& mesh = scan.mesh;
  EXPECT_LT(mesh.points.rows(), 4000);
  ASSERT_EQ(scan.corner_uv.rows(), 3 * mesh.triangles.rows());
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    double middle = 0;
    for (int k = 0; k < 3; ++k) middle += mesh.points(mesh.triangles(f, k), 0) / 3;
    for (int k = 0; k < 3; ++k) {
      const auto at = mesh.points.row(mesh.triangles(f, k));
      EXPECT_NEAR(scan.corner_uv(3 * f + k, 0), 4 * at[0] + (middle > 0.05 ? 0.5 : 0), 1e-5);
      EXPECT_NEAR(scan.corner_uv(3 * f + k, 1), 10 * at[1], 1e-5);
    }
  }
}

TEST(FewerVertices, KeepTheTextureOnBothSidesOfASeam) {
  expect_texture_of_curved_sheet(with_fewer_vertices(curved_sheet(true), {}, 3000).scan);
}

/// A file that repeats each vertex for each of its triangles.
io::Scan unwelded(const io::Scan& scan) {
  io::Scan out = scan;
  const Eigen::Index triangles = scan.mesh.triangles.rows();
  out.mesh.points.resize(3 * triangles, 3);
  for (Eigen::Index f = 0; f < triangles; ++f)
    for (int k = 0; k < 3; ++k) {
      out.mesh.points.row(3 * f + k) = scan.mesh.points.row(scan.mesh.triangles(f, k));
      out.mesh.triangles(f, k) = int(3 * f + k);
    }
  return out;
}

TEST(FewerVertices, KeepTheTextureOfAFileThatRepeatsVertices) {
  expect_texture_of_curved_sheet(with_fewer_vertices(unwelded(curved_sheet(true)), {}, 3000).scan);
}

TEST(FewerVertices, StayBesideLidsAndLips) {
  const io::Scan scan = curved_sheet(false);
  io::Landmarks eye;
  for (int k = 36; k <= 41; ++k) {
    const double turn = 2 * std::numbers::pi * (k - 36) / 6;
    eye[face::ibug(k)] = {0.05 + 0.01 * std::cos(turn), 0.05 + 0.005 * std::sin(turn), 0.004};
  }
  const auto beside = [](const TriMesh& mesh) {
    return std::ranges::count_if(std::views::iota(Eigen::Index(0), mesh.points.rows()),
                                 [&](Eigen::Index v) {
                                   return std::abs(mesh.points(v, 0) - 0.05) < 0.01 &&
                                          std::abs(mesh.points(v, 1) - 0.05) < 0.005;
                                 });
  };
  EXPECT_EQ(beside(with_fewer_vertices(scan, eye, 2500).scan.mesh), beside(scan.mesh));
  EXPECT_LT(beside(with_fewer_vertices(scan, {}, 2500).scan.mesh), beside(scan.mesh) / 2);
}

TEST(FewerVertices, AreNoneWhereTheScanHasNoMore) {
  const io::Scan scan = curved_sheet(false);
  const ThinnedScan same = with_fewer_vertices(scan, {}, 20000);
  EXPECT_EQ(same.scan.mesh.points, scan.mesh.points);
  EXPECT_EQ(same.off_m, 0);
}

}  // namespace
}  // namespace hyperex::rig
