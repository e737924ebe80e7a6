// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/skin_view.hpp"

#include <gtest/gtest.h>

#include "hyperex/geometry/cut_surface.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::report {
namespace {

constexpr int side = 9;
constexpr double cell = 0.005;

/// A flat textured sheet whose two halves take their texture from different places, and along the
/// seam between them hold their own vertices; cut across the seam as the lips of a scan are.
struct CutSheet {
  io::Scan scan;
  simulate::Performance performance;

  /// Texture coordinates and colour are linear over each half.
  static Eigen::Vector2f uv(double x, double y, bool right) {
    return {static_cast<float>((right ? 0.9 : 0.1) + 3 * x), static_cast<float>(0.2 + 5 * y - x)};
  }

  CutSheet() {
    Points joined(side * side, 3);
    for (int v = 0; v < side * side; ++v) joined.row(v) << cell * (v % side), cell * (v / side), 0;
    const int seam = side / 2;
    scan.mesh.points.resize(side * side + side, 3);
    scan.mesh.points.topRows(side * side) = joined;
    for (int j = 0; j < side; ++j)
      scan.mesh.points.row(side * side + j) = joined.row(j * side + seam);
    const TriMesh whole{joined, test::sheet_mesh({side - 1, side - 1}, {1, 1}).mesh.triangles};
    scan.mesh.triangles = whole.triangles;
    scan.corner_uv.resize(3 * whole.triangles.rows(), 2);
    for (Eigen::Index t = 0; t < whole.triangles.rows(); ++t) {
      const bool right = whole.triangles.row(t).maxCoeff() >= 0 && right_of_seam(whole, t);
      for (int k = 0; k < 3; ++k) {
        int& v = scan.mesh.triangles(t, k);
        scan.corner_uv.row(3 * t + k) = uv(joined(v, 0), joined(v, 1), right).transpose();
        if (right && v % side == seam) v = side * side + v / side;
      }
    }
    scan.vertex_colour.resize(scan.mesh.points.rows(), 4);
    for (Eigen::Index v = 0; v < scan.mesh.points.rows(); ++v)
      scan.vertex_colour.row(v) << static_cast<int>(std::lround(4000 * scan.mesh.points(v, 0))),
          static_cast<int>(std::lround(5000 * scan.mesh.points(v, 1))), 90, 255;

    Points line(2, 3);
    line << 1.2 * cell, 3.3 * cell, 0, 6.7 * cell, 4.6 * cell, 0;
    const CutSurface cut = cut_along_line(whole, line, Vec3::UnitZ());
    performance.scan_vertices = scan.mesh.points.rows();
    performance.appended = cut.appended;
    performance.source_triangle = cut.source_triangle;
    const auto added = static_cast<Eigen::Index>(cut.appended.size());
    performance.skin_rest.points.resize(performance.scan_vertices + added, 3);
    performance.skin_rest.points << scan.mesh.points, cut.mesh.points.bottomRows(added);
    performance.skin_rest.triangles = cut.mesh.triangles;
    for (Eigen::Index t = 0; t < cut.mesh.triangles.rows(); ++t)
      for (int k = 0; k < 3; ++k) {
        int& v = performance.skin_rest.triangles(t, k);
        if (v >= side * side)
          v += side;
        else if (v % side == seam && right_of_seam(whole, cut.source_triangle[t]))
          v = side * side + v / side;
      }
    scan.texture = io::Image{{1}, "image/png"};
  }

  static bool right_of_seam(const TriMesh& whole, Eigen::Index t) {
    double x = 0;
    for (int k = 0; k < 3; ++k) x += whole.points(whole.triangles(t, k), 0) / 3;
    return x > cell * (side / 2);
  }
};

TEST(SkinView, TextureCoordinatesOnTheCutLieBetweenTheScans) {
  const CutSheet sheet;
  const auto& skin = sheet.performance.skin_rest;
  ASSERT_GT(skin.triangles.rows(), sheet.scan.mesh.triangles.rows() + 5);
  const SkinView view = skin_view(sheet.performance, sheet.scan);
  ASSERT_EQ(view.triangles.rows(), skin.triangles.rows());
  int on_cut = 0;
  for (Eigen::Index f = 0; f < view.triangles.rows(); ++f) {
    double x = 0;
    for (int k = 0; k < 3; ++k) x += skin.points(skin.triangles(f, k), 0) / 3;
    for (int k = 0; k < 3; ++k) {
      const int v = skin.triangles(f, k), seen = view.triangles(f, k);
      ASSERT_EQ(view.skin_vertex[seen], v);
      on_cut += v >= sheet.performance.scan_vertices;
      const Eigen::Vector2f expected =
          CutSheet::uv(skin.points(v, 0), skin.points(v, 1), x > cell * (side / 2));
      EXPECT_LT((view.uv.row(seen).transpose() - expected).norm(), 2e-6) << f << ' ' << k;
    }
  }
  EXPECT_GT(on_cut, 40);
}

TEST(SkinView, WithoutATextureIsTheSkinItself) {
  CutSheet sheet;
  sheet.scan.texture.reset();
  const SkinView view = skin_view(sheet.performance, sheet.scan);
  EXPECT_TRUE(view.triangles == sheet.performance.skin_rest.triangles);
  EXPECT_EQ(view.skin_vertex.size(),
            static_cast<std::size_t>(sheet.performance.skin_rest.points.rows()));
  EXPECT_EQ(view.uv.rows(), 0);
}

TEST(SkinView, RefusesAnotherScansTriangles) {
  CutSheet sheet;
  sheet.performance.source_triangle.pop_back();
  EXPECT_THROW(skin_view(sheet.performance, sheet.scan), std::invalid_argument);
  CutSheet turned;
  turned.performance.source_triangle.front() = turned.performance.source_triangle[100];
  EXPECT_THROW(skin_view(turned.performance, turned.scan), std::invalid_argument);
}

TEST(SkinColour, OnTheCutLiesBetweenTheEdgesEnds) {
  const CutSheet sheet;
  const auto colour = skin_colour(sheet.performance, sheet.scan);
  const Points& points = sheet.performance.skin_rest.points;
  ASSERT_EQ(colour.rows(), points.rows());
  for (Eigen::Index v = 0; v < points.rows(); ++v) {  // linear over the sheet: off by rounding
    EXPECT_NEAR(colour(v, 0), 4000 * points(v, 0), 1) << v;
    EXPECT_NEAR(colour(v, 1), 5000 * points(v, 1), 1) << v;
    EXPECT_EQ(colour(v, 2), 90);
  }
}

}  // namespace
}  // namespace hyperex::report
