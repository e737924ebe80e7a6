// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/raster.hpp"

#include <gtest/gtest.h>

#include <random>

#include "hyperex/render/ray_scene.hpp"

namespace hyperex::render {
namespace {

constexpr int kSize = 150;
constexpr double kMetresPerSample = 0.4 / kSize;
const Camera oblique{.target = {0.01, 0.02, 0}, .to_viewer = {0.4, 0.3, 1}, .height_m = 0.4};

/// Separate triangles of all sizes, some far outside the picture.
TriMesh loose_triangles(int count) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> place(-0.4, 0.4), side(-0.06, 0.06);
  TriMesh mesh{Points(3 * count, 3), Triangles(count, 3)};
  for (int f = 0; f < count; ++f) {
    const Vec3 at(place(generator), place(generator), place(generator));
    for (int k = 0; k < 3; ++k) {
      const Vec3 off(side(generator), side(generator), side(generator));
      mesh.points.row(3 * f + k) = (at + (f % 3 ? 0.2 : 1) * off).transpose();
    }
    mesh.triangles.row(f) << 3 * f, 3 * f + 1, 3 * f + 2;
  }
  return mesh;
}

/// A sheet in the plane z = 0, of triangles between random points along its rows.
TriMesh sheet(int cells) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> off(-0.4, 0.4);
  const double step = 0.3 / cells;
  const int row = cells + 1;
  TriMesh mesh{Points(row * row, 3), Triangles(2 * cells * cells, 3)};
  for (int i = 0; i < row; ++i)
    for (int j = 0; j < row; ++j) {
      const bool inside = i > 0 && j > 0 && i < cells && j < cells;
      mesh.points.row(i * row + j) << -0.15 + step * (j + (inside ? off(generator) : 0)),
          -0.15 + step * (i + (inside ? off(generator) : 0)), 0;
    }
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const int at = i * row + j, f = 2 * (i * cells + j);
      mesh.triangles.row(f) << at, at + 1, at + row;
      mesh.triangles.row(f + 1) << at + 1, at + row + 1, at + row;
    }
  return mesh;
}

std::vector<Hit> all_hits(const Raster& raster) {
  std::vector<Hit> all;
  Raster::Seen seen;
  for (int b = 0; b < raster.bands(); ++b) {
    raster.look(b, seen);
    for (int i = 0; i < seen.rows * kSize; ++i) {
      Hit& hit = all.emplace_back();
      const int x = i % kSize, y = i / kSize;
      const int id = seen.triangle[std::size_t(y * seen.stride + x)];
      if (id < 0) continue;
      const Raster::Drawn& drawn = seen.drawn[std::size_t(id)];
      const auto w = drawn.weights(x, seen.first_row + y).at(0);
      hit = {drawn.surface, drawn.triangle, {w[0], w[1], w[2]}, raster.normal(drawn.id)};
      EXPECT_EQ(drawn.faces_viewer(), hit.normal.z() > 0);
    }
  }
  return all;
}

TEST(Raster, SeesWhatARayThroughEachSampleMeets) {
  const TriMesh one = loose_triangles(600);
  TriMesh two = loose_triangles(300);
  two.points.col(2).array() += 0.05;
  const std::vector<Surface> surfaces{{.mesh = one}, {.mesh = two}};
  const auto hits = all_hits(Raster(surfaces, oblique, kSize, kSize, kMetresPerSample, 16));
  ASSERT_EQ(hits.size(), std::size_t(kSize) * kSize);
  const RayScene rays(surfaces, oblique);
  int met = 0, others = 0;
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const Hit& hit = hits[std::size_t(y * kSize + x)];
      const auto expected = rays.look_at(float((x + 0.5 - kSize / 2.0) * kMetresPerSample),
                                         float((kSize / 2.0 - y - 0.5) * kMetresPerSample));
      met += expected.has_value();
      if (hit.surface != (expected ? expected->surface : -1) ||
          (expected && hit.triangle != expected->triangle)) {
        ++others;  // on an edge, by rounding
        continue;
      }
      if (!expected) continue;
      // A corner moved by 2^-15 of a sample; the smallest triangles are a few samples wide.
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(hit.weight[k], expected->weight[k], 2e-2);
      EXPECT_GT(hit.normal.dot(expected->normal), 0.99);
    }
  EXPECT_GT(met, kSize * kSize / 3);
  EXPECT_LT(others, 10);
}

TEST(Raster, LeavesNoGapBetweenTriangles) {
  const TriMesh mesh = sheet(60);
  const Camera front{.height_m = 0.4};
  const auto hits = all_hits(Raster({{.mesh = mesh}}, front, kSize, kSize, kMetresPerSample, 7));
  for (int y = 0; y < kSize; ++y)
    for (int x = 0; x < kSize; ++x) {
      const double off =
          0.4 * std::max(std::abs((x + 0.5) / kSize - 0.5), std::abs((y + 0.5) / kSize - 0.5));
      EXPECT_EQ(hits[std::size_t(y * kSize + x)].surface >= 0, off < 0.15) << x << ' ' << y;
    }
}

TEST(Raster, OfTwoEquallyNearTheFirstIsSeen) {
  const TriMesh mesh = sheet(5);
  const Camera front{.height_m = 0.4};
  for (const Hit& hit : all_hits(
           Raster({{.mesh = mesh}, {.mesh = mesh}}, front, kSize, kSize, kMetresPerSample, 64)))
    EXPECT_LT(hit.surface, 1);
}

TEST(Raster, TrianglesAsSurfacesOfTheirOwnAreSeenAsThoseOfOneSurface) {
  const TriMesh whole = loose_triangles(300);
  std::vector<TriMesh> parts;
  for (Eigen::Index f = 0; f < whole.triangles.rows(); ++f) {
    parts.push_back({whole.points.middleRows(3 * f, 3), Triangles(1, 3)});
    parts.back().triangles << 0, 1, 2;
  }
  std::vector<Surface> surfaces;
  for (const TriMesh& part : parts) surfaces.push_back({.mesh = part});
  const auto expected =
      all_hits(Raster({{.mesh = whole}}, oblique, kSize, kSize, kMetresPerSample, 16));
  const auto hits = all_hits(Raster(surfaces, oblique, kSize, kSize, kMetresPerSample, 16));
  ASSERT_EQ(hits.size(), expected.size());
  for (std::size_t i = 0; i < hits.size(); ++i) EXPECT_EQ(hits[i].surface, expected[i].triangle);
}

TEST(Raster, LeavesOutWhatIsNotFiniteOrSeenFromItsEdge) {
  TriMesh mesh = sheet(2);
  mesh.points(4, 2) = std::numeric_limits<double>::quiet_NaN();  // the middle one
  const Camera front{.height_m = 0.4};
  const auto middle = std::size_t(kSize / 2 * kSize + kSize / 2);
  EXPECT_EQ(
      all_hits(Raster({{.mesh = mesh}}, front, kSize, kSize, kMetresPerSample, 16))[middle].surface,
      -1);
  const Camera along{.to_viewer = {1, 0, 0}, .height_m = 0.4};
  const TriMesh flat = sheet(2);
  for (const Hit& hit :
       all_hits(Raster({{.mesh = flat}}, along, kSize, kSize, kMetresPerSample, 16)))
    EXPECT_EQ(hit.surface, -1);
}

}  // namespace
}  // namespace hyperex::render
