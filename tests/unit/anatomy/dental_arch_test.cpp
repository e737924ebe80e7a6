// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/dental_arch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {
namespace {

using Eigen::Index;

double volume_m3(const TriMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

/// The vertices of each tooth.
std::map<int, Points> teeth_of(const JawTeeth& jaw) {
  std::map<int, std::vector<int>> vertices;
  for (std::size_t f = 0; f < jaw.tooth.size(); ++f)
    for (int k = 0; k < 3; ++k) vertices[jaw.tooth[f]].push_back(jaw.crowns.triangles(Index(f), k));
  std::map<int, Points> out;
  for (auto& [tooth, list] : vertices) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    out[tooth] = jaw.crowns.points(list, Eigen::all);
  }
  return out;
}

TEST(DentalArches, HaveFourteenClosedCrownsEachAndAGum) {
  const Teeth teeth = dental_arches();
  for (const auto* jaw : {&teeth.upper, &teeth.lower}) {
    const auto crowns = teeth_of(*jaw);
    EXPECT_EQ(crowns.size(), 14u);
    const int quadrant = jaw == &teeth.upper ? 1 : 3;
    for (const auto& [tooth, points] : crowns) {
      EXPECT_TRUE(tooth / 10 == quadrant || tooth / 10 == quadrant + 1) << tooth;
      EXPECT_TRUE(tooth % 10 >= 1 && tooth % 10 <= 7) << tooth;
    }
    EXPECT_TRUE(boundary_loops(jaw->crowns.triangles).empty());
    EXPECT_TRUE(boundary_loops(jaw->gum.triangles).empty());
    const auto parts = triangle_components(jaw->crowns.triangles, jaw->crowns.points.rows());
    EXPECT_EQ(1 + *std::max_element(parts.begin(), parts.end()), 14);
    EXPECT_GT(volume_m3(jaw->crowns), 4e-6);
    EXPECT_GT(volume_m3(jaw->gum), 4e-6);
  }
}

TEST(DentalArches, CrownsAreAsLongAndAsWideAsPublished) {
  const Teeth teeth = dental_arches();
  // Sizes of upright front teeth seen from the front. 3 mm of root are hidden in the gum.
  const auto upper = teeth_of(teeth.upper);
  const Points& central = upper.at(21);
  EXPECT_NEAR(central.col(0).maxCoeff() - central.col(0).minCoeff(), 0.0085, 4e-4);
  const double lean = 16 * M_PI / 180;
  EXPECT_NEAR(central.col(1).maxCoeff() - central.col(1).minCoeff(), 0.0135 * std::cos(lean), 1e-3);
  const Points& molar = upper.at(26);
  EXPECT_NEAR(molar.col(0).maxCoeff() - molar.col(0).minCoeff(), 0.011, 2e-3);
}

TEST(DentalArches, NeighboursTouchAndDoNotOverlapByMuch) {
  const Teeth teeth = dental_arches();
  for (const auto* jaw : {&teeth.upper, &teeth.lower}) {
    const auto crowns = teeth_of(*jaw);
    const int quadrant = jaw == &teeth.upper ? 2 : 3;
    for (int i = 1; i < 7; ++i) {
      const Points& a = crowns.at(10 * quadrant + i);
      const Points& b = crowns.at(10 * quadrant + i + 1);
      double nearest = 1;
      for (Index v = 0; v < a.rows(); ++v)
        nearest = std::min(nearest, (b.rowwise() - a.row(v)).rowwise().norm().minCoeff());
      EXPECT_LT(nearest, 1.2e-3) << quadrant << i;
    }
  }
}

TEST(DentalArches, LowerTeethStandBehindAndUnderTheUpperOnes) {
  const Teeth teeth = dental_arches();
  const auto upper = teeth_of(teeth.upper), lower = teeth_of(teeth.lower);
  EXPECT_NEAR(upper.at(11).col(1).minCoeff(), 0, 3e-4);
  EXPECT_NEAR(lower.at(31).col(1).maxCoeff(), kOverbite_m, 3e-4);
  EXPECT_NEAR(upper.at(11).col(2).maxCoeff() - lower.at(31).col(2).maxCoeff(), kOverjet_m, 8e-4);
  for (const int tooth : {5, 6, 7})
    EXPECT_GT(upper.at(20 + tooth).col(1).minCoeff(), lower.at(30 + tooth).col(1).maxCoeff());
  EXPECT_GT(upper.at(26).col(0).maxCoeff(), lower.at(36).col(0).maxCoeff() + 5e-4);
}

TEST(DentalArches, AreTheirOwnMirrorImages) {
  const Teeth teeth = dental_arches();
  for (const TriMesh* part :
       {&teeth.upper.crowns, &teeth.upper.gum, &teeth.lower.crowns, &teeth.lower.gum}) {
    EXPECT_NEAR(part->points.col(0).maxCoeff(), -part->points.col(0).minCoeff(), 1e-12);
    EXPECT_NEAR(part->points.col(0).mean(), 0, 1e-9);
  }
}

TEST(DentalArches, GrowAndNarrow) {
  const Teeth normal = dental_arches(), large = dental_arches({.scale = 1.1});
  const Teeth narrow = dental_arches({.breadth = 0.9});
  EXPECT_LT((large.upper.crowns.points - 1.1 * normal.upper.crowns.points).cwiseAbs().maxCoeff(),
            1e-12);
  EXPECT_LT(narrow.lower.crowns.points.col(0).maxCoeff(),
            normal.lower.crowns.points.col(0).maxCoeff() - 0.002);
  EXPECT_LT(narrow.lower.crowns.points.col(2).minCoeff(),
            normal.lower.crowns.points.col(2).minCoeff() - 0.0005)
      << "longer";
  EXPECT_THROW(dental_arches({.scale = 0}), std::invalid_argument);
  EXPECT_THROW(dental_arches({.breadth = 2}), std::invalid_argument);
}

TEST(DistanceToTeeth, IsThatToTheirSurface) {
  const Teeth teeth = dental_arches();
  const auto distance = distance_to(teeth.upper);
  ASSERT_TRUE(distance);
  const TriMesh& crowns = teeth.upper.crowns;
  const Points normals = vertex_normals(crowns);
  Vec3 outward;
  // Labial faces of both central incisors, half a millimetre off, outside and inside.
  int looked = 0;
  for (Index v = 0; v < crowns.points.rows(); ++v) {
    const Vec3 p = crowns.points.row(v), n = normals.row(v);
    if (std::abs(p.x()) > 0.006 || std::abs(p.x()) < 0.002 || n.z() < 0.9 || p.y() > 0.006)
      continue;
    ++looked;
    EXPECT_NEAR(distance->at(p + 0.0005 * n, outward), 0.0005, 1e-4);
    EXPECT_GT(outward.dot(n), 0.94);
    EXPECT_NEAR(distance->at(p - 0.0003 * n, outward), -0.0003, 1e-4);
  }
  EXPECT_GT(looked, 10);
  EXPECT_EQ(distance_to(JawTeeth{}), nullptr);
}

}  // namespace
}  // namespace hyperex::anatomy
