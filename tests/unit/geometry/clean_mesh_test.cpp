// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/clean_mesh.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "hyperex/geometry/surface_topology.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TriMesh sheet() {
  return test::sheet_mesh({6, 5}, {0.06, 0.05}, [](double x, double y) { return x * y; }).mesh;
}

void append_vertex(TriMesh& mesh, const Vec3& p) {
  mesh.points.conservativeResize(mesh.points.rows() + 1, 3);
  mesh.points.bottomRows(1) = p.transpose();
}

void append_triangle(TriMesh& mesh, int a, int b, int c) {
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) << a, b, c;
}

/// Conditions that hold for every cleaned mesh.
void expect_sound(const CleanMesh& clean, const TriMesh& given) {
  std::set<std::pair<int, int>> directed;
  std::vector<char> used(clean.mesh.points.rows(), 0);
  for (Eigen::Index f = 0; f < clean.mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = clean.mesh.triangles(f, k), b = clean.mesh.triangles(f, (k + 1) % 3);
      EXPECT_TRUE(directed.insert({a, b}).second) << "edge used twice in one direction";
      used[a] = 1;
      const int source = given.triangles(clean.source_triangle[f], k);
      EXPECT_EQ(clean.mesh.points.row(a), given.points.row(source)) << "triangles kept their order";
    }
  EXPECT_THAT(used, testing::Each(1));
  ASSERT_EQ(static_cast<Eigen::Index>(clean.source_vertex.size()), clean.mesh.points.rows());
  for (Eigen::Index v = 0; v < clean.mesh.points.rows(); ++v)
    EXPECT_EQ(clean.mesh.points.row(v), given.points.row(clean.source_vertex[v]));
  const auto component = triangle_components(clean.mesh.triangles, clean.mesh.points.rows());
  EXPECT_THAT(component, testing::Each(0));
}

TEST(CleanMesh, LeavesASoundMeshAlone) {
  const TriMesh given = sheet();
  const CleanMesh clean = clean_mesh(given);
  EXPECT_EQ(clean.mesh.points, given.points);
  EXPECT_EQ(clean.mesh.triangles, given.triangles);
  EXPECT_TRUE(clean.notes.empty());
  expect_sound(clean, given);
}

TEST(CleanMesh, DropsUnusedVerticesSilently) {
  TriMesh given = sheet();
  append_vertex(given, {1, 1, 1});
  const CleanMesh clean = clean_mesh(given);
  EXPECT_EQ(clean.mesh.points.rows(), given.points.rows() - 1);
  expect_sound(clean, given);
}

TEST(CleanMesh, JoinsDuplicateVertices) {
  const TriMesh whole = sheet();
  TriMesh given{Points(3 * whole.triangles.rows(), 3), Triangles(whole.triangles.rows(), 3)};
  for (int f = 0; f < whole.triangles.rows(); ++f)  // a soup, as STL has it
    for (int k = 0; k < 3; ++k) {
      given.points.row(3 * f + k) = whole.points.row(whole.triangles(f, k));
      given.triangles(f, k) = 3 * f + k;
    }
  const CleanMesh clean = clean_mesh(given);
  EXPECT_EQ(clean.mesh.points.rows(), whole.points.rows());
  EXPECT_EQ(clean.mesh.triangles.rows(), whole.triangles.rows());
  EXPECT_EQ(boundary_loops(clean.mesh.triangles).size(), 1u);
  EXPECT_THAT(clean.notes, ElementsAre("138 duplicate vertices joined"));  // 60 x 3 - 42
  expect_sound(clean, given);
}

TEST(CleanMesh, DropsDegenerateTriangles) {
  TriMesh given = sheet();
  append_triangle(given, 0, 0, 1);
  append_vertex(given, (given.points.row(0) + given.points.row(1)).transpose() / 2);
  append_triangle(given, 1, 0, static_cast<int>(given.points.rows()) - 1);  // three on a line
  const CleanMesh clean = clean_mesh(given);
  EXPECT_EQ(clean.mesh.triangles.rows(), given.triangles.rows() - 2);
  EXPECT_THAT(clean.notes, ElementsAre("2 degenerate triangles dropped"));
  expect_sound(clean, given);
}

TEST(CleanMesh, DropsTurnedDoubledAndThirdTriangles) {
  TriMesh turned = sheet();
  std::swap(turned.triangles(30, 0), turned.triangles(30, 1));
  append_triangle(turned, turned.triangles(3, 0), turned.triangles(3, 1), turned.triangles(3, 2));
  append_vertex(turned, {0.02, 0.02, 0.05});
  append_triangle(turned, turned.triangles(8, 0), turned.triangles(8, 1),
                  static_cast<int>(turned.points.rows()) - 1);
  const CleanMesh clean = clean_mesh(turned);
  ASSERT_EQ(clean.notes.size(), 1u);
  EXPECT_THAT(clean.notes[0], HasSubstr("turned against their neighbours"));
  expect_sound(clean, turned);
  EXPECT_LE(clean.mesh.triangles.rows(), 60);
  EXPECT_GE(clean.mesh.triangles.rows(), 56) << "a turned triangle costs few of its neighbours";
}

TEST(CleanMesh, PartsPinchedVertices) {
  const test::Sheet whole = test::sheet_mesh({6, 6}, {0.06, 0.06});
  TriMesh given{whole.mesh.points, Triangles(0, 3)};  // two holes that touch at a corner
  for (int j = 0; j < 6; ++j)
    for (int i = 0; i < 6; ++i)
      if (!(i == j && (i == 2 || i == 3)))
        for (int half = 0; half < 2; ++half) {
          const auto t = whole.mesh.triangles.row(2 * (6 * j + i) + half);
          append_triangle(given, t[0], t[1], t[2]);
        }
  const CleanMesh clean = clean_mesh(given);
  EXPECT_THAT(clean.notes, ElementsAre("1 pinched vertices parted"));
  EXPECT_EQ(clean.mesh.points.rows(), 50);
  EXPECT_EQ(std::count(clean.source_vertex.begin(), clean.source_vertex.end(), whole.vertex(3, 3)),
            2);
  std::vector<std::size_t> lengths;
  for (const auto& loop : boundary_loops(clean.mesh.triangles)) lengths.push_back(loop.size());
  EXPECT_THAT(lengths, testing::UnorderedElementsAre(24u, 8u)) << "the two holes are one now";
  expect_sound(clean, given);
}

TEST(CleanMesh, PartsABowTie) {
  TriMesh given{Points(6, 3), Triangles(3, 3)};
  given.points << 0, 0, 0, -1, -1, 0, -1, 1, 0, 1, -1, 0, 1, 1, 0, 0, 3, 0;
  given.triangles << 0, 2, 1, 0, 3, 4, 5, 2, 0;  // the right triangle hangs on vertex 0 alone
  CleanOptions options;
  options.island_area_share = 0.4;
  const CleanMesh clean = clean_mesh(given, options);
  EXPECT_THAT(clean.notes, ElementsAre("1 pinched vertices parted", "1 small islands dropped"));
  EXPECT_EQ(clean.mesh.triangles.rows(), 2);
  expect_sound(clean, given);
}

TEST(CleanMesh, DropsIslands) {
  TriMesh given = sheet();
  const int n = static_cast<int>(given.points.rows());
  for (int island = 0; island < 2; ++island) {
    for (int k = 0; k < 3; ++k)
      append_vertex(given, {0.1 + 0.01 * (k == 1), 0.1 * island, 0.01 * (k == 2)});
    append_triangle(given, n + 3 * island, n + 3 * island + 1, n + 3 * island + 2);
  }
  const CleanMesh clean = clean_mesh(given);
  EXPECT_EQ(clean.mesh.triangles.rows(), 60);
  EXPECT_THAT(clean.notes, ElementsAre("2 small islands dropped"));
  expect_sound(clean, given);
}

TEST(CleanMesh, RefusesSeveralLargeSurfacesAndNothing) {
  const TriMesh one = sheet();
  TriMesh two{Points(2 * one.points.rows(), 3), Triangles(2 * one.triangles.rows(), 3)};
  two.points << one.points, one.points.array() + 1;
  two.triangles << one.triangles, one.triangles.array() + static_cast<int>(one.points.rows());
  EXPECT_THROW(clean_mesh(two), std::invalid_argument);
  TriMesh nothing{Points::Zero(3, 3), Triangles(1, 3)};
  nothing.triangles << 0, 1, 2;
  EXPECT_THROW(clean_mesh(nothing), std::invalid_argument);
  EXPECT_THROW(clean_mesh({}), std::invalid_argument);
}

}  // namespace
}  // namespace hyperex
