// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/border_fade.hpp"

#include <gtest/gtest.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::report {
namespace {

TEST(BorderFade, IsNoneInsideAndWholeWhereTheScanEnds) {
  const TriMesh face = anatomy::embedded_face().mesh;
  const Eigen::VectorXf fade = border_fade(face);
  ASSERT_EQ(fade.size(), face.points.rows());
  std::vector<std::vector<int>> loops = boundary_loops(face.triangles);
  ASSERT_EQ(loops.size(), 4u);
  std::ranges::sort(loops, {}, [&](const auto& loop) { return loop_length(loop, face.points); });
  for (const int v : loops.back()) EXPECT_EQ(fade[v], 0);
  for (std::size_t hole = 0; hole < 3; ++hole)
    for (const int v : loops[hole]) EXPECT_EQ(fade[v], 1) << "eyes and mouth are holes";
  // Half of the width from a border, half has faded.
  for (Eigen::Index v = 0; v < fade.size(); ++v) {
    double nearest_m = 1;
    for (const int b : loops.back())
      nearest_m = std::min(nearest_m, (face.points.row(v) - face.points.row(b)).norm());
    if (std::abs(nearest_m - 0.006) < 1e-4) {
      EXPECT_NEAR(fade[v], 0.5, 0.02);
    }
    if (nearest_m > 0.012) {
      EXPECT_EQ(fade[v], 1);
    }
  }
}

TEST(BorderFade, AClosedSurfaceDoesNotFade) {
  TriMesh closed;
  closed.points.resize(4, 3);
  closed.points << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  closed.triangles.resize(4, 3);
  closed.triangles << 0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3;
  EXPECT_EQ(border_fade(closed).minCoeff(), 1);
}

}  // namespace
}  // namespace hyperex::report
