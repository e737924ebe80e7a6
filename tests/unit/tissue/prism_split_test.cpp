// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/prism_split.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
namespace {

struct Layer {
  Triangles triangles;
  Points top, bottom;

  std::vector<std::array<Vec3, 4>> tets(const std::vector<double>& rank) const {
    std::vector<std::array<Vec3, 4>> all;
    for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
      const auto v = triangles.row(f);
      for (const auto& tet : split_prism(
               {rank[std::size_t(v[0])], rank[std::size_t(v[1])], rank[std::size_t(v[2])]})) {
        std::array<Vec3, 4> x;
        for (int i = 0; i < 4; ++i)
          x[std::size_t(i)] =
              (tet[std::size_t(i)].below ? bottom : top).row(v[tet[std::size_t(i)].corner]);
        all.push_back(x);
      }
    }
    return all;
  }
  double least_ratio(const std::vector<double>& rank) const {
    double least = 1;
    for (const auto& x : tets(rank)) least = std::min(least, radius_ratio(x));
    return least;
  }
};

Layer flat_layer() {
  Layer layer;
  const TriMesh sheet = test::sheet_mesh({4, 3}, {0.012, 0.009}).mesh;
  layer.triangles = sheet.triangles;
  layer.top = layer.bottom = sheet.points;
  layer.bottom.col(2).array() -= 0.003;
  return layer;
}

/// The inner node of one vertex is displaced sideways, as at the bottom of a fold.
Layer folded_layer() {
  Layer layer = flat_layer();
  constexpr int vertex = 13;  // inside
  layer.bottom.row(vertex) = layer.top.row(vertex) + Eigen::RowVector3d(0.0015, 0.0005, -0.002);
  return layer;
}

std::vector<double> numbers(Eigen::Index count) {
  std::vector<double> rank(std::size_t(count), 0);
  for (std::size_t v = 0; v < rank.size(); ++v) rank[v] = double(v);
  return rank;
}

double volume(const std::array<Vec3, 4>& x) {
  return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
}

TEST(PrismSplit, FillsThePrismWhateverTheOrder) {
  Layer prism{Triangles(1, 3), Points(3, 3), Points(3, 3)};
  prism.triangles << 0, 1, 2;
  prism.top << 0, 0, 0, 2, 0, 0, 0, 3, 0;
  prism.bottom = prism.top;
  prism.bottom.col(2).array() -= 1.5;
  std::vector<double> rank{0, 1, 2};
  do {
    double sum = 0;
    for (const auto& x : prism.tets(rank)) {
      EXPECT_NEAR(volume(x), 1.5, 1e-12);
      sum += volume(x);
    }
    EXPECT_NEAR(sum, 4.5, 1e-12);
  } while (std::next_permutation(rank.begin(), rank.end()));
}

TEST(PrismRanks, OfAPlumpLayerAreTheVerticesNumbers) {
  const Layer layer = flat_layer();
  ASSERT_GT(layer.least_ratio(numbers(20)), 0.2);
  EXPECT_EQ(prism_ranks(layer.triangles, layer.top, layer.bottom), numbers(20));
}

TEST(PrismRanks, AvoidFlatTetrahedraInAFold) {
  const Layer layer = folded_layer();
  const auto before = numbers(20);
  for (const auto& x : layer.tets(before)) ASSERT_GT(volume(x), 0);
  ASSERT_LT(layer.least_ratio(before), 0.1);
  const auto rank = prism_ranks(layer.triangles, layer.top, layer.bottom);
  EXPECT_GT(layer.least_ratio(rank), 4 * layer.least_ratio(before));
  for (const auto& x : layer.tets(rank)) EXPECT_GT(volume(x), 0);
  // Neighbours agree on every diagonal: no two vertices of an edge have one rank.
  for (Eigen::Index f = 0; f < layer.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      EXPECT_NE(rank[std::size_t(layer.triangles(f, k))],
                rank[std::size_t(layer.triangles(f, (k + 1) % 3))]);
}

TEST(RadiusRatio, OfARegularAnInvertedAndAFlatTetrahedron) {
  const std::array<Vec3, 4> regular{Vec3(1, 1, 1), Vec3(1, -1, -1), Vec3(-1, 1, -1),
                                    Vec3(-1, -1, 1)};
  const double sign = volume(regular) > 0 ? 1 : -1;
  EXPECT_NEAR(radius_ratio(regular), sign, 1e-12);
  EXPECT_NEAR(radius_ratio({regular[1], regular[0], regular[2], regular[3]}), -sign, 1e-12);
  EXPECT_EQ(radius_ratio({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(1, 1, 0)}), 0);
}

}  // namespace
}  // namespace hyperex::tissue
