// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/rim.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {
namespace {

/// A square of 60 mm with a slit 42 mm long that extends `half_m` to either side of the x axis.
TriMesh with_slit(double step_m, double half_m) {
  std::vector<double> x, y;
  for (double at = -0.03; at < 0.03 + 1e-9; at += step_m) x.push_back(at);
  for (double at = half_m; at < 0.03 + 1e-9; at += step_m)
    y.insert(y.begin(), -at), y.push_back(at);
  const auto nx = int(x.size());
  TriMesh mesh{Points(Eigen::Index(x.size() * y.size()), 3), {}};
  std::vector<Eigen::Vector3i> triangles;
  for (std::size_t j = 0; j < y.size(); ++j)
    for (std::size_t i = 0; i < x.size(); ++i) {
      mesh.points.row(Eigen::Index(j * x.size() + i)) << x[i], y[j], 0;
      if (j + 1 == y.size() || i + 1 == x.size()) continue;
      if (y[j] < 0 && y[j + 1] > 0 && std::max(std::abs(x[i]), std::abs(x[i + 1])) < 0.0211)
        continue;
      const int at = int(j) * nx + int(i);
      triangles.push_back({at, at + 1, at + nx});
      triangles.push_back({at + 1, at + nx + 1, at + nx});
    }
  mesh.triangles.resize(Eigen::Index(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    mesh.triangles.row(Eigen::Index(f)) = triangles[f].transpose();
  return mesh;
}

/// A fine skin whose slit is closed except for 0.2 mm, over a coarse surface whose slit is 4 mm
/// wide.
class Rim : public testing::Test {
 protected:
  Rim() : skin_(with_slit(0.001, 0.0001)), outer_(with_slit(0.003, 0.002)) {
    const SurfaceTree tree(outer_);
    for (Eigen::Index v = 0; v < skin_.points.rows(); ++v) {
      const ClosestPoint c = tree.query(skin_.points.row(v).transpose());
      Anchor anchor;
      for (int k = 0; k < 3; ++k) anchor.node[std::size_t(k)] = outer_.triangles(c.triangle, k);
      anchor.weight = c.weights;
      anchors_.push_back(anchor);
    }
    std::vector<char> border;
    for (Eigen::Index n = 0; n < outer_.points.rows(); ++n)
      border.push_back(outer_.points.row(n).cwiseAbs().maxCoeff() > 0.0299);
    rim_ = rim_vertices(skin_, outer_, anchors_, border);
  }
  Vec3 at(const RimVertex& one) const { return skin_.points.row(one.vertex).transpose(); }

  TriMesh skin_, outer_;
  std::vector<Anchor> anchors_;
  std::vector<RimVertex> rim_;
};

TEST_F(Rim, LiesAroundTheHoleAlone) {
  EXPECT_GT(rim_.size(), 60u);
  for (const RimVertex& one : rim_) {
    EXPECT_LT(std::abs(at(one).x()), 0.0265);
    EXPECT_LT(std::abs(at(one).y()), 0.0055);
  }
}

TEST_F(Rim, CarriesWhatIsEqualEverywhereAsItIs) {
  for (const RimVertex& one : rim_) {
    double sum = 0;
    for (const double weight : one.weight) sum += weight;
    EXPECT_NEAR(sum, 1, 1e-12);
  }
}

/// The surface ends 1.9 mm short of the rim; its closest point alone would miss the field's growth
/// over that distance.
TEST_F(Rim, FollowsAFieldThatGrowsTowardsTheRim) {
  const auto field = [](const Vec3& x) { return 0.5 * std::abs(x.y()); };
  double off = 0, off_anchor = 0;
  for (const RimVertex& one : rim_) {
    if (std::abs(at(one).x()) > 0.0025) continue;  // at the ends both sides take part
    double moved = 0, anchored = 0;
    for (std::size_t k = 0; k < one.node.size(); ++k)
      moved += one.weight[k] * field(outer_.points.row(one.node[k]).transpose());
    const Anchor& anchor = anchors_[std::size_t(one.vertex)];
    for (int k = 0; k < 3; ++k)
      anchored +=
          anchor.weight[k] * field(outer_.points.row(anchor.node[std::size_t(k)]).transpose());
    if (std::abs(at(one).y()) > 0.00011) continue;
    off = std::max(off, std::abs(moved - field(at(one))));
    off_anchor = std::max(off_anchor, std::abs(anchored - field(at(one))));
  }
  EXPECT_NEAR(off_anchor, 0.95e-3, 1e-6);
  EXPECT_LT(off, 0.7 * off_anchor);
}

/// A path from the middle of one lip to that of the other is longer than the fit's range.
TEST_F(Rim, HearsNothingOfTheOtherLip) {
  int looked_at = 0;
  for (const RimVertex& one : rim_) {
    if (std::abs(at(one).x()) > 0.0025) continue;
    ++looked_at;
    for (std::size_t k = 0; k < one.node.size(); ++k) {
      EXPECT_GT(outer_.points(one.node[k], 1) * at(one).y(), 0) << at(one).transpose();
    }
  }
  EXPECT_GT(looked_at, 30);
}

/// While the mouth opens, the distance between neighbours on the rim increases by no more than the
/// field between them.
TEST_F(Rim, NeighboursStayTogetherWhereItIsDrawnOpen) {
  const auto opening = [](const Vec3& x) {
    const double across = std::max(0.0, 1 - std::pow(x.x() / 0.021, 2));
    return x.y() > 0 ? 0.0 : -0.02 * across;
  };
  std::vector<std::pair<double, double>> lower;  // x, displacement along the rim
  for (const RimVertex& one : rim_) {
    if (std::abs(at(one).y() + 0.0001) > 1e-6) continue;
    double moved = 0;
    for (std::size_t k = 0; k < one.node.size(); ++k)
      moved += one.weight[k] * opening(outer_.points.row(one.node[k]).transpose());
    lower.emplace_back(at(one).x(), moved);
  }
  std::sort(lower.begin(), lower.end());
  ASSERT_GT(lower.size(), 25u);
  for (std::size_t i = 1; i < lower.size(); ++i)
    EXPECT_LT(std::abs(lower[i].second - lower[i - 1].second), 0.004) << lower[i].first;
}

}  // namespace
}  // namespace hyperex::tissue
