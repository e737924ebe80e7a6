// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/turned_triangles.hpp"

#include <gmock/gmock.h>

#include <utility>

#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

TriMesh plain_sheet() {
  return test::sheet_mesh({20, 20}, {0.2, 0.2}, [](double, double) { return 0.0; }).mesh;
}

void turn(TriMesh& mesh, Eigen::Index triangle) {
  std::swap(mesh.triangles(triangle, 0), mesh.triangles(triangle, 1));
}

TEST(TurnedTriangles, AreFoundByTheirEdges) {
  TriMesh mesh = plain_sheet();
  EXPECT_EQ(turned_edge_share(mesh), 0);
  EXPECT_EQ(turned_triangles_doubt(mesh), "");
  const Eigen::Index half = mesh.triangles.rows() / 2;
  for (Eigen::Index f = 0; f < half; ++f) turn(mesh, f);
  const double seam = turned_edge_share(mesh);
  EXPECT_GT(seam, 0) << "where the halves meet";
  for (Eigen::Index f = half; f < mesh.triangles.rows(); ++f) turn(mesh, f);
  EXPECT_EQ(turned_edge_share(mesh), 0) << "all turned: alike again";
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); f += 3) turn(mesh, f);
  EXPECT_GT(turned_edge_share(mesh), 0.2);
  EXPECT_THAT(turned_triangles_doubt(mesh), testing::HasSubstr("turned inside out"));
}

/// Each triangle has vertices of its own, as in files with a normal per corner.
TEST(TurnedTriangles, AreFoundWhereTrianglesShareNoVertices) {
  const TriMesh whole = plain_sheet();
  TriMesh parted{Points(whole.triangles.size(), 3), whole.triangles};
  for (Eigen::Index i = 0; i < whole.triangles.size(); ++i) {
    parted.points.row(i) = whole.points.row(whole.triangles.data()[i]);
    parted.triangles.data()[i] = int(i);
  }
  EXPECT_EQ(turned_edge_share(parted), 0);
  for (Eigen::Index f = 0; f < parted.triangles.rows(); f += 3) turn(parted, f);
  EXPECT_GT(turned_edge_share(parted), 0.2);
}

TEST(TurnedTriangles, OfNoneAreNone) {
  EXPECT_EQ(turned_edge_share({}), 0);
}

}  // namespace
}  // namespace hyperex
