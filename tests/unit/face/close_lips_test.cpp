// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/close_lips.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/face/canonical_face.hpp"

namespace hyperex::face {
namespace {

double gap_m(const Points& points, std::size_t i) {
  const auto& contour = lip_contour();
  return points(contour[i], 1) - points(contour[contour.size() - i], 1);
}

TEST(CloseLips, LeavesTwoTenthsOfAMillimetreAlongTheWholeMouth) {
  const Points parted = canonical_face().mesh.points;
  Points closed = parted;
  close_lips(closed, lip_contour());
  for (std::size_t i = 1; i < lip_contour().size() / 2; ++i) {
    EXPECT_GT(gap_m(parted, i), 2.5e-3) << i;
    EXPECT_GT(gap_m(closed, i), 0) << i;
    EXPECT_LT(gap_m(closed, i), 0.6e-3) << i << ": the two lips' vertices do not face each other";
  }
  EXPECT_NEAR(gap_m(closed, 5), 0.2e-3, 0.02e-3);
  // The lower lip's share is the larger one.
  const Points moved = closed - parted;
  EXPECT_NEAR(moved(14, 1) / (moved(14, 1) - moved(13, 1)), 0.7, 1e-9);
}

TEST(CloseLips, MovesTheFaceSmoothlyAndAsItsMirrorImage) {
  const Points parted = canonical_face().mesh.points;
  Points closed = parted;
  close_lips(closed, lip_contour());
  const auto& mirror = mirrored_vertices();
  for (Eigen::Index v = 0; v < closed.rows(); ++v) {
    const Vec3 moved = (closed - parted).row(v), image = (closed - parted).row(mirror[v]);
    EXPECT_NEAR(moved.y(), image.y(), 0.2e-3) << v;
    EXPECT_EQ(moved.x(), 0) << v;
    if (parted(v, 1) > -0.01) {
      EXPECT_LT(moved.norm(), 0.1e-3) << v << ": nose, cheeks and eyes stay";
    }
  }
  // Corners stay, what lies below them moves less than the lip.
  for (const int corner : {78, 308}) EXPECT_EQ(closed.row(corner), parted.row(corner));
}

TEST(CloseLips, NoTriangleTurnsOver) {
  const CanonicalFace& face = canonical_face();
  const Triangles triangles = opened_triangles(face);
  Points closed = face.mesh.points;
  close_lips(closed, lip_contour());
  const auto normal = [&](const Points& points, Eigen::Index f) -> Vec3 {
    const Vec3 a = points.row(triangles(f, 0)), b = points.row(triangles(f, 1)),
               c = points.row(triangles(f, 2));
    return (b - a).cross(c - a);
  };
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    const Vec3 before = normal(face.mesh.points, f), after = normal(closed, f);
    EXPECT_GT(after.norm(), 0.2 * before.norm()) << f;
    EXPECT_GT(after.normalized().dot(before.normalized()), 0.3) << f;
  }
}

}  // namespace
}  // namespace hyperex::face
