// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/lip_surfaces.hpp"

#include <gtest/gtest.h>

#include "hyperex/face/ibug.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::simulate {
namespace {

/// Two flat lips that face +z, 30 mm wide and 8 mm high, with a common edge along y = 0.
struct FlatLips {
  tissue::TissueMesh mesh;
  io::Landmarks landmarks;
  Eigen::Index half = 0;  ///< vertices of the upper one, which come first

  explicit FlatLips(const Vec3& lower_by = Vec3::Zero()) {
    const auto sheet = hyperex::test::sheet_mesh({30, 8}, {0.030, 0.008}).mesh;
    half = sheet.points.rows();
    TriMesh& skin = mesh.skin;
    skin.points.resize(2 * half, 3);
    skin.points << sheet.points, sheet.points.rowwise() - Eigen::RowVector3d(0, 0.008, 0);
    skin.points.bottomRows(half).rowwise() += lower_by.transpose();
    skin.triangles.resize(2 * sheet.triangles.rows(), 3);
    skin.triangles << sheet.triangles, sheet.triangles.array() + static_cast<int>(half);
    mesh.skin_upper_margin.assign(std::size_t(2 * half), 0.01);
    std::fill(mesh.skin_upper_margin.begin() + half, mesh.skin_upper_margin.end(), -0.01);
    for (int k = 61; k <= 67; ++k)
      landmarks[face::ibug(k)] = {0.015 + 0.004 * (k < 64 ? k - 62 : 66 - k), 0, 0};
    landmarks[face::ibug(36)] = {-0.03, 0.06, 0};
    landmarks[face::ibug(45)] = {0.06, 0.06, 0};
    landmarks[face::ibug(27)] = {0.015, 0.06, 0};
    landmarks[face::ibug(8)] = {0.015, -0.04, 0};
    landmarks[face::ibug(48)] = {0, 0, 0};
    landmarks[face::ibug(54)] = {0.03, 0, 0};
  }
  PointsF moved(const Vec3& by) const {
    PointsF d = PointsF::Zero(2 * half, 3);
    d.bottomRows(half).rowwise() = by.transpose().cast<float>();
    return d;
  }
};

TEST(LipSurfaces, PassThroughNothingAtRestAndApart) {
  const FlatLips flat;
  const LipSurfaces lips(flat.mesh, flat.landmarks);
  ASSERT_FALSE(lips.empty());
  EXPECT_EQ(lips.depth(flat.moved(Vec3::Zero())), 0);
  EXPECT_EQ(lips.depth(flat.moved({0, -0.002, 0})), 0) << "open";
  EXPECT_EQ(lips.depth(flat.moved({0, -0.001, -0.002})), 0) << "behind, but below the rim";
  EXPECT_EQ(lips.depth(flat.moved({0, 0.003, 0.001})), 0) << "in front of the upper lip";
}

TEST(LipSurfaces, DepthIsToTheNearestSurface) {
  const FlatLips flat;
  const LipSurfaces lips(flat.mesh, flat.landmarks);
  // Above the rim by 1 mm and behind by 3 mm: nearest is the part that goes inwards.
  EXPECT_NEAR(lips.depth(flat.moved({0.0001, 0.001, -0.003})), 0.001, 1e-6);
  // Above by 4 mm and behind by 1 mm: nearest is the skin in front.
  EXPECT_NEAR(lips.depth(flat.moved({0.0001, 0.004, -0.001})), 0.001, 1e-6);
}

TEST(LipSurfaces, PairsKnowTheWayOut) {
  const FlatLips flat;
  const LipSurfaces lips(flat.mesh, flat.landmarks);
  const PointsF by = flat.moved({0.0001, 0.001, -0.003});
  const auto pairs = lips.pairs(by(lips.lower(), Eigen::all).cast<double>(),
                                by(lips.upper(), Eigen::all).cast<double>(), 0);
  ASSERT_FALSE(pairs.empty());
  for (const LipPair& pair : pairs) {
    if (pair.gap_m > -5e-4) continue;  // those on the rim itself
    EXPECT_LT((pair.normal - Vec3(0, -1, 0)).norm(), 1e-3) << "down, out of the upper lip";
    EXPECT_NEAR(pair.weight.sum(), 1, 1e-12);
  }
}

TEST(LipSurfaces, AllowsWhatOverlapsAtRest) {
  const FlatLips flat(Vec3(0.0001, 0.001, -0.003));
  const LipSurfaces lips(flat.mesh, flat.landmarks);
  EXPECT_EQ(lips.depth(flat.moved(Vec3::Zero())), 0);
  EXPECT_NEAR(lips.depth(flat.moved({0, 0.0004, 0})), 0.0004, 1e-6);
  EXPECT_EQ(lips.depth(flat.moved({0, -0.0004, 0})), 0);
}

TEST(LipSurfaces, AVertexBehindAFoldOfSkinIsNotInside) {
  FlatLips flat;
  // The lowest 2 mm of the upper lip are folded up in front of it, as scans have it at the corners.
  // The lip's skin then has its inner side on both sides, and nothing is between them.
  for (Eigen::Index v = 0; v < flat.half; ++v)
    if (auto p = flat.mesh.skin.points.row(v); p.y() < 0.0019) p << p.x(), 0.004 - p.y(), 0.0003;
  const LipSurfaces lips(flat.mesh, flat.landmarks);
  EXPECT_EQ(lips.depth(flat.moved({0.0001, 0.0031, -0.0005})), 0);
}

TEST(LipSurfaces, NothingToMeasureWithoutLips) {
  FlatLips flat;
  for (auto& [name, p] : flat.landmarks) p += Vec3(1, 1, 1);
  const LipSurfaces lips(flat.mesh, flat.landmarks);
  EXPECT_TRUE(lips.empty());
  EXPECT_EQ(lips.depth(flat.moved({0, 0.003, -0.001})), 0);
}

}  // namespace
}  // namespace hyperex::simulate
