// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/thin_mesh.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/cut_surface.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

constexpr double kSide_m = 0.04;
constexpr ThinOptions kOptions{.edge_m = 1e-3, .tolerance_m = 5e-5};

/// Edges of 0.2 mm, radii of curvature down to 6 mm.
test::Sheet waves() {
  return test::sheet_mesh({200, 200}, {kSide_m, kSide_m}, [](double x, double y) {
    return 1e-3 * std::sin(x / 2.5e-3) * std::cos(y / 4e-3);
  });
}

TEST(ThinMesh, IsAsNearAsAskedAndHasFarFewerVertices) {
  const TriMesh mesh = waves().mesh;
  const ThinMesh thin = thin_mesh(mesh, kOptions);
  EXPECT_LT(6 * thin.mesh.points.rows(), mesh.points.rows());
  EXPECT_TRUE(clean_mesh(thin.mesh).notes.empty()) << "a sound surface";
  // Both ways, by a search of its own.
  double there = 0, back = 0;
  for (const auto& hit : SurfaceTree(thin.mesh).query_all(mesh.points))
    there = std::max(there, std::sqrt(hit.squared_distance));
  Points centres(thin.mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < centres.rows(); ++f)
    centres.row(f) = (thin.mesh.points.row(thin.mesh.triangles(f, 0)) +
                      thin.mesh.points.row(thin.mesh.triangles(f, 1)) +
                      thin.mesh.points.row(thin.mesh.triangles(f, 2))) /
                     3;
  for (const auto& hit : SurfaceTree(mesh).query_all(centres))
    back = std::max(back, std::sqrt(hit.squared_distance));
  EXPECT_LE(there, kOptions.tolerance_m + 1e-12);
  EXPECT_LE(back, 1.5 * kOptions.tolerance_m);
  EXPECT_GT(there, 1e-6) << "it was thinned";
  EXPECT_NEAR(thin.greatest_distance_m, there, 0.1 * there);
}

TEST(ThinMesh, KeepsVerticesOfTheGivenMeshAndPlacesTheOthers) {
  const TriMesh mesh = waves().mesh;
  const ThinMesh thin = thin_mesh(mesh, kOptions);
  for (std::size_t v = 0; v < thin.source_vertex.size(); ++v)
    ASSERT_TRUE(thin.mesh.points.row(Eigen::Index(v)) == mesh.points.row(thin.source_vertex[v]));
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const MeshPlace& place = thin.places[std::size_t(v)];
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      at += place.weight[k] * thin.mesh.points.row(place.vertex[std::size_t(k)]).transpose();
    ASSERT_LE((at - mesh.points.row(v).transpose()).norm(), thin.greatest_distance_m + 1e-12);
  }
  for (Eigen::Index f = 0; f < thin.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      ASSERT_LE((thin.mesh.points.row(thin.mesh.triangles(f, k)) -
                 thin.mesh.points.row(thin.mesh.triangles(f, (k + 1) % 3)))
                    .norm(),
                1.6 * kOptions.edge_m + 1e-12);
}

TEST(ThinMesh, KeepsBordersAndWhatIsHeld) {
  const test::Sheet sheet = waves();
  std::vector<char> held(std::size_t(sheet.mesh.points.rows()), 0);
  for (int i = 0; i <= 200; ++i) held[std::size_t(sheet.vertex(i, 77))] = 1;
  const ThinMesh thin = thin_mesh(sheet.mesh, kOptions, held);
  const std::set<int> left(thin.source_vertex.begin(), thin.source_vertex.end());
  for (int i = 0; i <= 200; ++i)
    for (const int v : {sheet.vertex(i, 77), sheet.vertex(i, 0), sheet.vertex(0, i)})
      EXPECT_TRUE(left.contains(v));
  EXPECT_EQ(boundary_loops(thin.mesh.triangles).front().size(), 800u);
}

TEST(ThinMesh, PlacesOnTheVertexsOwnSideOfASlit) {
  const test::Sheet sheet = waves();
  std::vector<int> path;
  for (int i = 50; i <= 150; ++i) path.push_back(sheet.vertex(i, 100));
  const CutSurface cut = cut_along(sheet.mesh, path);
  const ThinMesh thin = thin_mesh(cut.mesh, kOptions);
  const double slit = kSide_m / 2;
  for (int i = 60; i < 140; ++i)
    for (const int j : {97, 98, 99, 101, 102, 103})
      for (const int corner : thin.places[std::size_t(sheet.vertex(i, j))].vertex) {
        const double y = thin.mesh.points(corner, 1);
        EXPECT_TRUE(j < 100 ? y <= slit + 1e-9 : y >= slit - 1e-9) << i << ' ' << j;
      }
}

TEST(ThinMesh, ARoughSurfaceKeepsMoreAndSaysHowFarItIs) {
  TriMesh mesh = waves().mesh;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)  // up to 0.1 mm
    mesh.points(v, 2) += 1e-4 * std::sin(12.9898 * double(v) * double(v % 89));
  ThinOptions options = kOptions;
  const ThinMesh strict = thin_mesh(mesh, options);
  EXPECT_GT(strict.mesh.points.rows(), 2 * thin_mesh(waves().mesh, options).mesh.points.rows());
  EXPECT_LE(strict.greatest_distance_m, kOptions.tolerance_m + 1e-12);
  options.enough_vertices = 1000;  // the tolerance is doubled twice
  const ThinMesh loose = thin_mesh(mesh, options);
  EXPECT_LT(loose.mesh.points.rows(), strict.mesh.points.rows());
  EXPECT_GT(loose.greatest_distance_m, strict.greatest_distance_m);
  EXPECT_LE(loose.greatest_distance_m, 4 * kOptions.tolerance_m + 1e-12);
}

}  // namespace
}  // namespace hyperex
