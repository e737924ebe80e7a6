// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/plump.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "hyperex/tissue/canonical_face.hpp"
#include "hyperex/tissue/tissue_mesh.hpp"
#include "support/fem_support.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
namespace {

double worst_ratio(const Points& nodes, const Tetrahedra& tets) {
  double worst = 1;
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    worst = std::min(worst, radius_ratio(nodes, tets, t));
  return worst;
}

/// A regular tetrahedron cut into four around a node inside, which is the last.
struct Split {
  Points nodes{5, 3};
  Tetrahedra tets{4, 4};

  explicit Split(const Vec3& inside, double size = 1e-3) {
    nodes << 1, 1, 1, -1, 1, -1, 1, -1, -1, -1, -1, 1, inside.transpose();
    nodes *= size;
    tets << 4, 1, 2, 3, 0, 4, 2, 3, 0, 1, 4, 3, 0, 1, 2, 4;
    for (Eigen::Index t = 0; t < 4; ++t)
      if (test::volume_of(nodes, tets, t) < 0) std::swap(tets(t, 0), tets(t, 1));
  }
};

TEST(PlumpUp, BringsANodeToTheMiddleOfARegularTetrahedron) {
  // By symmetry the minimum is the centre, which is also where the worst of the four is best.
  for (const double size : {1e-3, 1.0}) {
    Split split({0.3, -0.25, 0.4}, size);
    const double before = worst_ratio(split.nodes, split.tets);
    const Plumped done = plump_up(split.nodes, split.tets, 4, 1);
    EXPECT_EQ(done.nodes, 1);
    EXPECT_LT(split.nodes.row(4).norm(), 1e-3 * size);
    EXPECT_NEAR(done.greatest_move_m, Vec3(0.3, -0.25, 0.4).norm() * size, 2e-3 * size);
    EXPECT_GT(worst_ratio(split.nodes, split.tets), 1.5 * before);
  }
}

TEST(PlumpUp, LeavesHeldAndPlumpOnesToTheBit) {
  Split split({0.3, -0.25, 0.4});
  const Points before = split.nodes;
  EXPECT_EQ(plump_up(split.nodes, split.tets, 5, 1).nodes, 0) << "all are held";
  EXPECT_EQ(split.nodes, before);
  const double worst = worst_ratio(split.nodes, split.tets);
  EXPECT_EQ(plump_up(split.nodes, split.tets, 0, 0.99 * worst).nodes, 0) << "none is flat";
  EXPECT_EQ(split.nodes, before);
  EXPECT_EQ(plump_up(split.nodes, split.tets, 4, 1.01 * worst).nodes, 1);
}

/// A layer whose middle has been pressed flat at one place.
struct Pressed {
  VolumeMesh mesh;
  int node = 0;

  Pressed() {
    const test::Sheet sheet = test::sheet_mesh({8, 6}, {0.04, 0.03});
    mesh =
        build_volume_mesh(sheet.mesh, Eigen::VectorXd::Constant(sheet.mesh.points.rows(), 0.008));
    node = static_cast<int>(mesh.surface_nodes()) + sheet.vertex(4, 3);
    mesh.nodes(node, 2) = -0.00005;  // of 4 mm
  }
};

TEST(PlumpUp, RepairsAPressedLayerNearby) {
  Pressed pressed;
  VolumeMesh& mesh = pressed.mesh;
  const Points before = mesh.nodes;
  ASSERT_LT(worst_ratio(mesh.nodes, mesh.tets), 0.03);
  const Plumped done = plump_up(mesh.nodes, mesh.tets, mesh.surface_nodes(), 0.2);
  EXPECT_GT(worst_ratio(mesh.nodes, mesh.tets), 0.2);
  EXPECT_GT(done.nodes, 0);
  EXPECT_EQ(mesh.nodes.topRows(mesh.surface_nodes()), before.topRows(mesh.surface_nodes()))
      << "the skin";
  int moved = 0;
  for (Eigen::Index v = 0; v < before.rows(); ++v) {
    if (mesh.nodes.row(v) == before.row(v)) continue;
    ++moved;
    EXPECT_LT((before.row(v) - before.row(pressed.node)).norm(), 0.013) << "far from the place";
  }
  EXPECT_EQ(moved, done.nodes);
}

TEST(PlumpUp, IsTheSameEachTimeAndInAnyUnit) {
  Pressed a, b, large;
  large.mesh.nodes *= 1024;  // exact
  plump_up(a.mesh.nodes, a.mesh.tets, a.mesh.surface_nodes(), 0.2);
  plump_up(b.mesh.nodes, b.mesh.tets, b.mesh.surface_nodes(), 0.2);
  plump_up(large.mesh.nodes, large.mesh.tets, large.mesh.surface_nodes(), 0.2);
  EXPECT_EQ(a.mesh.nodes, b.mesh.nodes);
  EXPECT_LT((large.mesh.nodes / 1024 - a.mesh.nodes).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(PlumpUp, DoesNotTouchWhatIsInverted) {
  Split split({0.3, -0.25, 0.4});
  split.nodes.row(4) *= -4;  // outside
  ASSERT_LT(worst_ratio(split.nodes, split.tets), 0);
  EXPECT_EQ(plump_up(split.nodes, split.tets, 4, 1).nodes, 0);
}

TEST(PlumpUp, KeepsTheFaceFromFlatElements) {
  const EmbeddedFace face = embedded_face();
  const TissueMesh mesh = build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded");
  EXPECT_GT(mesh.quality.worst_radius_ratio, 0.03) << "0.012 without";
  EXPECT_EQ(mesh.volume.nodes.topRows(mesh.volume.surface_nodes()), mesh.volume.outer.points);
  for (int v = 0; v < mesh.volume.surface_nodes(); ++v)
    EXPECT_NEAR(
        mesh.volume.thickness_m[v],
        (mesh.volume.nodes.row(mesh.volume.inner_node(v)) - mesh.volume.nodes.row(v)).norm(),
        1e-12);
}

}  // namespace
}  // namespace hyperex::tissue
