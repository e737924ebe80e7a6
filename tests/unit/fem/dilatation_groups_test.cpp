// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/dilatation_groups.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/box_mesh.hpp"

namespace hyperex::fem {
namespace {

struct Stars : testing::Test {
  test::BoxMesh box = test::box_mesh({6, 5, 4}, Vec3(0.06, 0.05, 0.04));
  DilatationGroups groups = disjoint_stars(box.nodes.rows(), box.tets);
  Lists around = transposed(corner_lists(box.tets), static_cast<int>(box.nodes.rows()));
};

TEST_F(Stars, HoldEachTetrahedronOnce) {
  std::vector<int> count(box.tets.rows(), 0);
  for (const int t : groups.tets.item) ++count[t];
  for (const int times : count) EXPECT_EQ(times, 1);
  EXPECT_EQ(groups.kept, 0);
}

TEST_F(Stars, EachPatchHasTheWholeStarOfANodeAndIsNotSmall) {
  for (int g = 0; g < groups.tets.size(); ++g) {
    const auto patch = groups.tets[g];
    const auto whole = [&](int n) {
      return std::includes(patch.begin(), patch.end(), around[n].begin(), around[n].end());
    };
    EXPECT_GE(patch.size(), 8) << "patch " << g;
    bool found = false;
    for (int n = 0; n < around.size() && !found; ++n) found = whole(n);
    EXPECT_TRUE(found) << "patch " << g;
  }
}

TEST_F(Stars, AreNeitherFewNorMany) {
  // A star has a centre and up to fourteen nodes around it that cannot be centres; some lie
  // between.
  EXPECT_GE(groups.tets.size(), box.nodes.rows() / 14);
  EXPECT_LE(groups.tets.size(), box.nodes.rows() / 4);
}

TEST_F(Stars, AreTheSameOnEachRun) {
  const DilatationGroups again = disjoint_stars(box.nodes.rows(), box.tets);
  EXPECT_EQ(again.tets.start, groups.tets.start);
  EXPECT_EQ(again.tets.item, groups.tets.item);
}

TEST(Groups, ThePlainElementHasNone) {
  const auto box = test::box_mesh({2, 2, 2}, Vec3(1, 1, 1));
  EXPECT_EQ(dilatation_groups(ElementKind::tet4, box.nodes.rows(), box.tets).tets.size(), 0);
}

TEST(Groups, TakeOneTetrahedronAndANodeThatNoElementUses) {
  const Tetrahedra one = (Tetrahedra(1, 4) << 0, 1, 3, 4).finished();
  const DilatationGroups groups = disjoint_stars(5, one);
  EXPECT_EQ(groups.tets.size(), 1);
  EXPECT_EQ(groups.tets.item, std::vector<int>{0});
}

TEST(Groups, TakePartsTooSmallForAStarAndPartsApart) {
  // A lone tetrahedron beside a box: a patch of its own.
  const auto box = test::box_mesh({3, 3, 3}, Vec3(1, 1, 1));
  Tetrahedra tets(box.tets.rows() + 1, 4);
  const int n = static_cast<int>(box.nodes.rows());
  tets << box.tets, n, n + 1, n + 2, n + 3;
  const DilatationGroups groups = disjoint_stars(n + 4, tets);
  std::vector<int> count(tets.rows(), 0);
  bool alone = false;
  for (int g = 0; g < groups.tets.size(); ++g) {
    for (const int t : groups.tets[g]) ++count[t];
    alone |= groups.tets[g].size() == 1 && groups.tets[g][0] == tets.rows() - 1;
  }
  EXPECT_TRUE(alone);
  for (const int times : count) EXPECT_EQ(times, 1);
}

}  // namespace
}  // namespace hyperex::fem
