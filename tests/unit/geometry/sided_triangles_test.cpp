// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/sided_triangles.hpp"

#include <gtest/gtest.h>

namespace hyperex {
namespace {

using Open = std::vector<char>;

TriMesh strip() {
  TriMesh mesh{Points::Zero(5, 3), Triangles(3, 3)};
  mesh.triangles << 0, 1, 2, 1, 2, 3, 2, 3, 4;
  return mesh;
}

TEST(SidedTriangles, BarTheOtherLip) {
  const SidedTriangles sided(strip(), {1, 0, 0, 0, -1});
  EXPECT_EQ(sided.open_to(1), (Open{1, 1, 0}));
  EXPECT_EQ(sided.open_to(-1), (Open{0, 1, 1}));
  EXPECT_EQ(sided.open_to(0), (Open{1, 1, 1}));
}

TEST(SidedTriangles, AreAllOpenWhereNoneWouldBeLeft) {
  EXPECT_EQ(SidedTriangles(strip(), {}).open_to(1), (Open{1, 1, 1}));
  const SidedTriangles sided(strip(), {0, 0, 1, 0, 0});
  EXPECT_EQ(sided.open_to(-1), (Open{1, 1, 1})) << "each has the vertex in the middle";
  EXPECT_EQ(sided.open_to(1), (Open{1, 1, 1}));
}

}  // namespace
}  // namespace hyperex
