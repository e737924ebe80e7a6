// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/volume_mesh.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "support/fem_support.hpp"
#include "support/note_matchers.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
namespace {

constexpr double width = 0.04, height = 0.03;

VolumeMesh layer_under(const TriMesh& outer, double thickness, int layers = 2) {
  VolumeMeshOptions options;
  options.layers = layers;
  return build_volume_mesh(outer, Eigen::VectorXd::Constant(outer.points.rows(), thickness),
                           options);
}

TriMesh dome(double curvature) {
  return test::sheet_mesh({12, 9}, {width, height},
                          [&](double x, double y) {
                            return -curvature / 2 *
                                   (std::pow(x - width / 2, 2) + std::pow(y - height / 2, 2));
                          })
      .mesh;
}

double least_volume(const VolumeMesh& mesh) {
  double least = 1;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
    least = std::min(least, test::volume_of(mesh.nodes, mesh.tets, t));
  return least;
}

/// Checks that every face belongs to one tetrahedron, on the outside, or to two on opposite sides.
void expect_conforming(const VolumeMesh& mesh) {
  constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};  // outwards
  std::map<std::array<int, 3>, std::vector<bool>> seen;                     // even permutation?
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
    for (const auto& f : face) {
      std::array<int, 3> v{mesh.tets(t, f[0]), mesh.tets(t, f[1]), mesh.tets(t, f[2])};
      std::rotate(v.begin(), std::min_element(v.begin(), v.end()), v.end());
      const bool even = v[1] < v[2];
      std::sort(v.begin(), v.end());
      seen[v].push_back(even);
    }
  std::size_t outside = 0, border = 0;
  for (const auto& [v, sides] : seen) {
    ASSERT_LE(sides.size(), 2u);
    if (sides.size() == 2)
      EXPECT_NE(sides[0], sides[1]);
    else
      ++outside;
  }
  for (const auto& loop : boundary_loops(mesh.outer.triangles)) border += loop.size();
  EXPECT_EQ(outside, 2 * mesh.outer.triangles.rows() + 2 * mesh.layers * border)
      << "skin, inner surface and two triangles a layer along the border";
}

class Layers : public testing::TestWithParam<int> {};

TEST_P(Layers, UnderAFlatSheetAreExact) {
  const TriMesh sheet = test::sheet_mesh({8, 6}, {width, height}).mesh;
  const int layers = GetParam();
  const VolumeMesh mesh = layer_under(sheet, 0.006, layers);
  EXPECT_EQ(mesh.layers, layers);
  EXPECT_EQ(mesh.surface_nodes(), sheet.points.rows());
  EXPECT_EQ(mesh.nodes.rows(), sheet.points.rows() * (layers + 1));
  EXPECT_EQ(mesh.tets.rows(), sheet.triangles.rows() * layers * 3);
  EXPECT_EQ(mesh.outer.points, sheet.points);
  EXPECT_EQ(mesh.outer.triangles, sheet.triangles);
  EXPECT_EQ(mesh.nodes.topRows(sheet.points.rows()), sheet.points) << "level 0 is the skin";
  EXPECT_TRUE(mesh.notes.empty());
  double sum = 0;
  for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
    sum += test::volume_of(mesh.nodes, mesh.tets, t);
  EXPECT_NEAR(sum, width * height * 0.006, 1e-15);
  EXPECT_GT(least_volume(mesh), 0);
  for (int v = 0; v < mesh.surface_nodes(); ++v) {
    EXPECT_NEAR(mesh.thickness_m[v], 0.006, 1e-12);
    const Vec3 down = (mesh.nodes.row(mesh.inner_node(v)) - mesh.nodes.row(v)).transpose();
    EXPECT_LT((down - Vec3(0, 0, -0.006)).norm(), 1e-12) << "inwards, against the normal";
  }
  expect_conforming(mesh);
}

INSTANTIATE_TEST_SUITE_P(OneToThree, Layers, testing::Values(1, 2, 3));

TEST(VolumeMesh, CurvedSheetsConformWithPositiveVolumes) {
  for (const double curvature : {20.0, -20.0, 60.0}) {  // convex, concave, a fingertip
    const VolumeMesh mesh = layer_under(dome(curvature), 0.006);
    EXPECT_GT(least_volume(mesh), 0) << curvature;
    expect_conforming(mesh);
    for (int v = 0; v < mesh.surface_nodes(); ++v) {
      const double built = (mesh.nodes.row(mesh.inner_node(v)) - mesh.nodes.row(v)).norm();
      EXPECT_NEAR(mesh.thickness_m[v], built, 1e-12);
      EXPECT_LT(built, 0.0061);
    }
  }
}

TEST(VolumeMesh, MeetsThicknessOnAGentleCurve) {
  const VolumeMesh mesh = layer_under(dome(5), 0.005);
  EXPECT_NEAR(mesh.thickness_m.minCoeff(), 0.005, 1e-12);
  EXPECT_NEAR(mesh.thickness_m.maxCoeff(), 0.005, 1e-12);
}

TEST(VolumeMesh, IsNoThinnerAtACrease) {
  // Two slopes of 40 degrees: below them directions part, and none needs to be turned.
  const TriMesh valley = test::sheet_mesh({24, 8}, {width, height}, [](double x, double) {
                           return 0.84 * std::abs(x - width / 2);
                         }).mesh;
  const VolumeMesh mesh = layer_under(valley, 0.004);
  EXPECT_TRUE(mesh.notes.empty());
  EXPECT_GT(mesh.thickness_m.minCoeff(), 0.004 - 1e-12) << "directions that cancel in a mean";
}

TEST(VolumeMesh, FollowsAVaryingThickness) {
  const TriMesh sheet = test::sheet_mesh({20, 6}, {0.1, 0.03}).mesh;
  Eigen::VectorXd wanted(sheet.points.rows());
  for (Eigen::Index v = 0; v < wanted.size(); ++v) wanted[v] = 0.004 + 0.06 * sheet.points(v, 0);
  const VolumeMesh mesh = build_volume_mesh(sheet, wanted);
  for (Eigen::Index v = 0; v < wanted.size(); ++v)
    if (sheet.points(v, 0) > 0.02 && sheet.points(v, 0) < 0.08) {
      EXPECT_NEAR(mesh.thickness_m[v], wanted[v], 1e-12);
    }
}

TEST(VolumeMesh, ThinsAndTurnsWhereTheLayerWouldFold) {
  // A groove of 5 mm radius cannot hold 12 mm.
  const TriMesh groove = test::sheet_mesh({24, 8}, {width, height}, [](double x, double) {
                           const double d = x - width / 2;
                           return std::abs(d) < 0.005 ? 0.005 - std::sqrt(2.5e-5 - d * d) : 0.005;
                         }).mesh;
  TriMesh ridge = groove;  // seen from the other side: its inside is the narrow one
  ridge.points.col(2) *= -1;
  const VolumeMesh mesh = layer_under(ridge, 0.012);
  EXPECT_GT(least_volume(mesh), 0);
  expect_conforming(mesh);
  EXPECT_THAT(mesh.notes, testing::ElementsAre(test::is_note("mesh.layer_thinned")));
  EXPECT_LT(mesh.thickness_m.minCoeff(), 0.012);
  EXPECT_GT(mesh.thickness_m.minCoeff(), 0);
}

TEST(VolumeMesh, RefusesAFoldedSurface) {
  TriMesh pillow{Points(3, 3), Triangles(2, 3)};
  pillow.points << 0, 0, 0, 0.01, 0, 0, 0, 0.01, 0;
  pillow.triangles << 0, 1, 2, 0, 2, 1;
  EXPECT_THROW(layer_under(pillow, 0.005), NumericalError);
}

TEST(Quality, OfARegularTetrahedron) {
  Points nodes(4, 3);
  nodes << 1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1;
  nodes *= 1e-3;
  Tetrahedra tets(1, 4);
  tets << 0, 1, 2, 3;
  if (test::volume_of(nodes, tets, 0) < 0) std::swap(tets(0, 2), tets(0, 3));
  const MeshQuality q = quality_of(nodes, tets);
  EXPECT_NEAR(q.total_volume_mm3, 8.0 / 3, 1e-12);
  EXPECT_NEAR(q.least_volume_mm3, q.mean_volume_mm3, 1e-12);
  EXPECT_NEAR(q.least_dihedral_deg, std::acos(1.0 / 3) * 180 / M_PI, 1e-9);
  EXPECT_NEAR(q.greatest_dihedral_deg, q.least_dihedral_deg, 1e-9);
  EXPECT_NEAR(q.worst_radius_ratio, 1, 1e-12);
  EXPECT_THAT(q.least_dihedral_shares, testing::ElementsAre(0, 0, 0, 0, 1));
}

TEST(Quality, OfTheCornerOfACubeAndAFlatOne) {
  Points nodes(5, 3);
  nodes << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0.1;
  nodes *= 1e-3;
  Tetrahedra tets(1, 4);
  tets << 0, 1, 2, 3;
  const MeshQuality corner = quality_of(nodes, tets);
  EXPECT_NEAR(corner.total_volume_mm3, 1.0 / 6, 1e-12);
  EXPECT_NEAR(corner.greatest_dihedral_deg, 90, 1e-9);
  EXPECT_NEAR(corner.least_dihedral_deg, std::acos(1 / std::sqrt(3.0)) * 180 / M_PI, 1e-9);
  // r = 3 V / S = 1 / (3 + sqrt 3), R = sqrt(3) / 2
  EXPECT_NEAR(corner.worst_radius_ratio, 3 / (3 + std::sqrt(3.0)) / (std::sqrt(3.0) / 2), 1e-12);
  Tetrahedra both(2, 4);
  both << 0, 1, 2, 3, 0, 1, 2, 4;
  const MeshQuality q = quality_of(nodes, both);
  EXPECT_NEAR(q.least_volume_mm3, 1.0 / 60, 1e-12);
  EXPECT_NEAR(q.mean_volume_mm3, 11.0 / 120, 1e-12);
  // The flat one's least angle lies at the slanted edge: tan = 0.1 sqrt 2.
  EXPECT_NEAR(q.least_dihedral_deg, std::atan(0.1 * std::sqrt(2.0)) * 180 / M_PI, 1e-9);
  EXPECT_THAT(q.least_dihedral_shares, testing::ElementsAre(0, 0.5, 0, 0, 0.5));
  EXPECT_LT(q.worst_radius_ratio, corner.worst_radius_ratio);
}

}  // namespace
}  // namespace hyperex::tissue
