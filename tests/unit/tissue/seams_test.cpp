// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/seams.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
namespace {

/// A flat square of 40 mm around the origin.
TriMesh sheet(double step_m) {
  const int cells = int(std::lround(0.04 / step_m));
  TriMesh mesh = test::sheet_mesh({cells, cells}, {0.04, 0.04}).mesh;
  mesh.points.leftCols<2>().array() -= 0.02;
  return mesh;
}

/// A skin over a coarser surface. Below the seam y = 0.5 mm, the skin moves with nodes `apart_m`
/// lower than it lies.
class Seams : public testing::Test {
 protected:
  Seams() : skin_(sheet(0.001)), outer_(sheet(0.004)) {}
  void anchor(double apart_m) {
    const SurfaceTree tree(outer_);
    anchors_.clear();
    for (Eigen::Index v = 0; v < skin_.points.rows(); ++v) {
      Vec3 at = skin_.points.row(v).transpose();
      if (at.y() < 0.0005) at.y() -= apart_m;
      const ClosestPoint c = tree.query(at);
      Anchor one;
      for (int k = 0; k < 3; ++k) one.node[std::size_t(k)] = outer_.triangles(c.triangle, k);
      one.weight = c.weights;
      anchors_.push_back(one);
    }
  }
  /// Displacement of the skin where the nodes are displaced by `field`.
  Eigen::VectorXd moved(const std::vector<RimVertex>& rim,
                        const std::function<double(const Vec3&)>& field) const {
    const auto at = [&](int node) { return field(outer_.points.row(node).transpose()); };
    Eigen::VectorXd out(skin_.points.rows());
    for (Eigen::Index v = 0; v < out.size(); ++v) {
      out[v] = 0;
      for (int k = 0; k < 3; ++k)
        out[v] +=
            anchors_[std::size_t(v)].weight[k] * at(anchors_[std::size_t(v)].node[std::size_t(k)]);
    }
    for (const RimVertex& one : rim) {
      out[one.vertex] = 0;
      for (std::size_t k = 0; k < one.node.size(); ++k)
        out[one.vertex] += one.weight[k] * at(one.node[k]);
    }
    return out;
  }
  double widest_step(const Eigen::VectorXd& of_skin) const {
    double most = 0;
    for (const auto t : skin_.triangles.rowwise())
      for (int k = 0; k < 3; ++k)
        most = std::max(most, std::abs(of_skin[t[k]] - of_skin[t[(k + 1) % 3]]));
    return most;
  }

  TriMesh skin_, outer_;
  std::vector<Anchor> anchors_;
};

double downwards(const Vec3& x) {
  return x.y();
}

TEST_F(Seams, NeighboursNoLongerSeparate) {
  anchor(0.006);
  EXPECT_NEAR(widest_step(moved({}, downwards)), 0.007, 1e-9);
  const auto rim = smooth_seams(skin_, outer_, anchors_, {});
  // 7 mm over the 8 mm of skin that is changed.
  EXPECT_LT(widest_step(moved(rim, downwards)), 0.0025);
}

TEST_F(Seams, SkinBeyondFourMillimetresIsAsItWas) {
  anchor(0.006);
  const auto rim = smooth_seams(skin_, outer_, anchors_, {});
  ASSERT_GT(rim.size(), 300u);
  for (const RimVertex& one : rim)
    EXPECT_LT(std::abs(skin_.points(one.vertex, 1) - 0.0005), 0.0046);
  EXPECT_TRUE(std::is_sorted(rim.begin(), rim.end(), [](const RimVertex& a, const RimVertex& b) {
    return a.vertex < b.vertex;
  }));
}

/// The border of the changed skin shows no kink: from vertex to vertex the slope changes no more
/// than elsewhere.
TEST_F(Seams, TheChangedSkinJoinsTheOtherSmoothly) {
  anchor(0.006);
  const Eigen::VectorXd of_skin = moved(smooth_seams(skin_, outer_, anchors_, {}), downwards);
  const int row = 41;
  double most = 0;
  for (int j = 10; j < 31; ++j) {
    const int v = j * row + row / 2;
    most = std::max(most, std::abs(of_skin[v + row] - 2 * of_skin[v] + of_skin[v - row]));
  }
  EXPECT_LT(most, 0.0008);
}

TEST_F(Seams, WhatIsEqualEverywhereStaysSo) {
  anchor(0.006);
  for (const RimVertex& one : smooth_seams(skin_, outer_, anchors_, {})) {
    double sum = 0;
    for (const double weight : one.weight) sum += weight;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

/// Its neighbours share no node in any case.
TEST_F(Seams, ASkinAsCoarseAsTheSurfaceIsAsItWas) {
  skin_ = sheet(0.004);
  anchor(0.006);
  EXPECT_TRUE(smooth_seams(skin_, outer_, anchors_, {}).empty());
}

TEST_F(Seams, WithoutASeamTheRimIsAsItWas) {
  anchor(0);
  const std::vector<RimVertex> given = {{7, {1, 2}, {0.25, 0.75}}};
  const auto rim = smooth_seams(skin_, outer_, anchors_, given);
  ASSERT_EQ(rim.size(), 1u);
  EXPECT_EQ(rim[0].vertex, 7);
  EXPECT_EQ(rim[0].node, given[0].node);
  EXPECT_EQ(rim[0].weight, given[0].weight);
}

/// A vertex of the rim that moves otherwise than those around it makes a seam, too.
TEST_F(Seams, MayLieBetweenTheRimAndItsNeighbours) {
  anchor(0);
  const int middle = 20 * 41 + 20;
  const std::vector<RimVertex> given = {{middle, {0}, {1}}};
  EXPECT_GT(widest_step(moved(given, downwards)), 0.018);
  const auto rim = smooth_seams(skin_, outer_, anchors_, given);
  EXPECT_GT(rim.size(), 20u);
  EXPECT_LT(widest_step(moved(rim, downwards)), 0.0012);
}

/// Skin that no other moves, such as an island of the scan, keeps a smooth displacement.
TEST_F(Seams, AnIslandOfSkinIsMovedAsAWhole) {
  anchor(0.006);
  // Only the triangles within 3 mm of the origin.
  std::vector<Eigen::Vector3i> kept;
  for (const auto t : skin_.triangles.rowwise())
    if (skin_.points.row(t[0]).norm() < 0.003) kept.push_back(t.transpose());
  skin_.triangles.resize(Eigen::Index(kept.size()), 3);
  for (std::size_t f = 0; f < kept.size(); ++f)
    skin_.triangles.row(Eigen::Index(f)) = kept[f].transpose();
  const auto rim = smooth_seams(skin_, outer_, anchors_, {});
  EXPECT_GT(rim.size(), 10u);
  EXPECT_LT(widest_step(moved(rim, downwards)), 0.003);
}

}  // namespace
}  // namespace hyperex::tissue
