// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "support/note_matchers.hpp"
#include "support/subdivided.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {

constexpr double kElement_m = 0.005;

TriMesh large_face() {
  TriMesh mesh = embedded_face().mesh;
  while (mesh.points.rows() <= thinned_above_vertices) mesh = test::subdivided(mesh);
  return mesh;
}

io::Landmarks landmarks_of(const TriMesh& face) {
  std::vector<std::string> needed;
  for (const auto& entry : canonical_face().landmarks) needed.push_back(entry.first);
  return complete_landmarks(embedded_face().landmarks, needed, face).landmarks;
}

TEST(ThinnedSkin, OfALargeScanIsMeshedAndTheScansOwnVerticesHaveTheirPlaces) {
  const TriMesh scan = large_face();
  TissueMeshOptions options;
  options.element_size_m = kElement_m;
  const TissueMesh mesh = build_tissue_mesh(scan, landmarks_of(scan), options, "large");
  ASSERT_TRUE(mesh.full);
  EXPECT_LT(2 * mesh.skin.points.rows(), scan.points.rows());
  EXPECT_EQ(mesh.scan_vertices, mesh.skin.points.rows());
  EXPECT_EQ(mesh.anchors.size(), std::size_t(mesh.skin.points.rows()));
  EXPECT_EQ(mesh.skin_upper_margin.size(), mesh.anchors.size());
  const FullSkin& full = *mesh.full;
  ASSERT_EQ(full.scan_vertices, scan.points.rows());
  EXPECT_TRUE(full.skin.points.topRows(full.scan_vertices) == scan.points);
  ASSERT_EQ(full.places.size(), std::size_t(full.skin.points.rows()));
  double most = 0;
  for (std::size_t v = 0; v < full.places.size(); ++v) {
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      at += full.places[v].weight[k] *
            mesh.skin.points.row(full.places[v].vertex[std::size_t(k)]).transpose();
    most = std::max(most, (at - full.skin.points.row(Eigen::Index(v)).transpose()).norm());
  }
  EXPECT_LT(most, 1e-4);
  for (std::size_t v = 0; v < full.kept.size(); ++v)
    ASSERT_TRUE(mesh.skin.points.row(Eigen::Index(v)) == full.skin.points.row(full.kept[v]));
  EXPECT_THAT(mesh.notes, testing::Contains(test::is_note("scan.thinned")));
}

TEST(ThinnedSkin, OfAScanOfUsualSizeIsTheScanItself) {
  const TriMesh& scan = embedded_face().mesh;
  TissueMeshOptions options;
  options.element_size_m = kElement_m;
  const TissueMesh mesh = build_tissue_mesh(scan, landmarks_of(scan), options, "usual");
  EXPECT_FALSE(mesh.full);
  EXPECT_TRUE(mesh.skin.points.topRows(mesh.scan_vertices) == scan.points);
}

}  // namespace
}  // namespace hyperex::tissue
