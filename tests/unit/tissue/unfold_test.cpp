// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/unfold.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/geometry/surface_topology.hpp"
#include "support/note_matchers.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::tissue {
namespace {

/// Triangles from an apex to the corners of a polygon around it, counter-clockwise from +z.
TriMesh fan(const std::vector<Vec3>& rim, const Vec3& apex) {
  const auto n = static_cast<Eigen::Index>(rim.size());
  TriMesh mesh{Points(n + 1, 3), Triangles(n, 3)};
  mesh.points.row(n) = apex.transpose();
  for (Eigen::Index i = 0; i < n; ++i) {
    mesh.points.row(i) = rim[i].transpose();
    mesh.triangles.row(i) << static_cast<int>(i), static_cast<int>((i + 1) % n),
        static_cast<int>(n);
  }
  return mesh;
}

std::vector<Vec3> circle(int n) {
  std::vector<Vec3> rim;
  for (int i = 0; i < n; ++i)
    rim.emplace_back(std::cos(2 * M_PI * i / n), std::sin(2 * M_PI * i / n), 0);
  return rim;
}

double least_cosine(const TriMesh& mesh, int vertex, const Vec3& direction) {
  double least = 1;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    if ((mesh.triangles.row(f).array() != vertex).all()) continue;
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    least = std::min(least, direction.dot((b - a).cross(c - a).normalized()));
  }
  return least;
}

TEST(Visibility, OfAPlaneIsItsNormal) {
  const TriMesh mesh = test::sheet_mesh({4, 4}, {1, 1}).mesh;
  const Visibility seen = visibility_of(mesh);
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    EXPECT_NEAR(seen.least[v], 1, 1e-12);
    EXPECT_NEAR(seen.direction(v, 2), 1, 1e-12);
  }
}

TEST(Visibility, OfAPyramidIsItsAxis) {
  const TriMesh mesh = fan(circle(8), {0, 0, 1.5});
  const Visibility seen = visibility_of(mesh);
  // Faces through the chords: their distance from the axis is cos(pi/8), they rise by 1.5 over it.
  const double run = std::cos(M_PI / 8), expected = run / std::hypot(run, 1.5);
  EXPECT_NEAR(seen.least[8], expected, 1e-3);
  EXPECT_GT(seen.direction(8, 2), 0.999);
}

TEST(Visibility, IsNearlyTheBestThereIs) {
  const TriMesh mesh =
      fan({{1, 0, 0.3}, {0.4, 0.8, -0.5}, {-0.7, 0.6, 0.4}, {-1, -0.4, -0.6}, {0.3, -0.9, 0.5}},
          {0.2, 0.1, 0.4});
  const Visibility seen = visibility_of(mesh);
  double best = -1;
  for (int i = 0; i <= 200; ++i)
    for (int j = 0; j < 400; ++j) {
      const double polar = M_PI * i / 200, turn = 2 * M_PI * j / 400;
      best = std::max(best, least_cosine(mesh, 5,
                                         {std::sin(polar) * std::cos(turn),
                                          std::sin(polar) * std::sin(turn), std::cos(polar)}));
    }
  EXPECT_GT(seen.least[5], best - 0.03);
  EXPECT_NEAR(seen.least[5], least_cosine(mesh, 5, seen.direction.row(5)), 1e-12);
  EXPECT_NEAR(seen.direction.row(5).norm(), 1, 1e-12);
}

TEST(Visibility, IsNotPositiveWhereFolded) {
  std::vector<Vec3> rim = circle(6);
  std::swap(rim[2], rim[3]);  // walks back over itself
  EXPECT_LE(visibility_of(fan(rim, {0, 0, 0})).least[6], 0);
}

TEST(Visibility, UpdateAfterAMoveIsThatOfTheWhole) {
  test::Sheet sheet = test::sheet_mesh({10, 10}, {0.05, 0.05});
  TriMesh& mesh = sheet.mesh;
  Visibility seen = visibility_of(mesh);
  std::vector<char> moved(mesh.points.rows(), 0);
  for (const auto& [x, y] : {std::pair{5, 5}, {9, 2}, {0, 10}}) {
    moved[sheet.vertex(x, y)] = 1;
    mesh.points.row(sheet.vertex(x, y)) += Eigen::RowVector3d(0.004, -0.002, 0.003);
  }
  update_visibility(mesh, moved, vertex_triangles(mesh.triangles, mesh.points.rows()), seen);
  const Visibility whole = visibility_of(mesh);
  EXPECT_EQ(seen.direction, whole.direction);
  EXPECT_EQ(seen.least, whole.least);
}

TEST(Unfold, LeavesASmoothSurfaceAlone) {
  const TriMesh mesh = test::sheet_mesh({10, 10}, {0.05, 0.05}, [](double x, double y) {
                         return 4 * x * (0.05 - x) + 3 * y * (0.05 - y);
                       }).mesh;
  std::vector<Note> notes;
  const TriMesh out = unfold(mesh, notes);
  EXPECT_EQ(out.points, mesh.points);
  EXPECT_EQ(out.triangles, mesh.triangles);
  EXPECT_TRUE(notes.empty());
}

TEST(Unfold, SmoothsAFold) {
  test::Sheet sheet = test::sheet_mesh({10, 10}, {0.05, 0.05});
  sheet.mesh.points.row(sheet.vertex(5, 5)) << 0.037, 0.026, 0.002;  // over its neighbours
  ASSERT_LT(visibility_of(sheet.mesh).least.minCoeff(), 0.3);
  std::vector<Note> notes;
  const TriMesh out = unfold(sheet.mesh, notes);
  EXPECT_GE(visibility_of(out).least.minCoeff(), 0.3);
  EXPECT_EQ(out.triangles, sheet.mesh.triangles) << "smoothing was enough";
  EXPECT_THAT(notes, testing::ElementsAre(test::is_note("mesh.folds_smoothed")));
  EXPECT_EQ(out.points.row(0), sheet.mesh.points.row(0)) << "what is sound stays";
}

TEST(Unfold, MendsAFoldOverTheBorder) {
  test::Sheet sheet = test::sheet_mesh({10, 10}, {0.05, 0.05});
  TriMesh& mesh = sheet.mesh;
  const int a = sheet.vertex(9, 10), b = sheet.vertex(10, 10);
  mesh.points.conservativeResize(mesh.points.rows() + 1, 3);
  mesh.points.bottomRows(1) << 0.047, 0.049, 0;
  const int tip = static_cast<int>(mesh.points.rows()) - 1;
  mesh.triangles.conservativeResize(mesh.triangles.rows() + 1, 3);
  mesh.triangles.bottomRows(1) << a, b, tip;  // folded back over the sheet's own border triangle
  ASSERT_LT(visibility_of(mesh).least.minCoeff(), 0.3);
  std::vector<Note> notes;
  const TriMesh out = unfold(mesh, notes);
  EXPECT_GE(visibility_of(out).least.minCoeff(), 0.3);
  EXPECT_GT(triangle_areas(out).sum(), 0.9 * 0.0025) << "little is lost";
  EXPECT_THAT(notes, testing::Contains(test::is_note("mesh.folds_smoothed")));
}

}  // namespace
}  // namespace hyperex::tissue
