// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/lip_contact.hpp"

#include <gtest/gtest.h>

#include "hyperex/face/ibug.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::reenact {
namespace {

/// Two flat lips facing +z, 30 mm wide and 8 mm high, edge to edge along y = 0.
struct FlatLips {
  tissue::TissueMesh mesh;
  io::Landmarks landmarks;
  Eigen::Index half = 0;  ///< vertices of the upper one, which come first

  FlatLips() {
    const auto sheet = hyperex::test::sheet_mesh({15, 4}, {0.030, 0.008}).mesh;
    half = sheet.points.rows();
    TriMesh& skin = mesh.skin;
    skin.points.resize(2 * half, 3);
    skin.points << sheet.points, sheet.points.rowwise() - Eigen::RowVector3d(0, 0.008, 0);
    skin.triangles.resize(2 * sheet.triangles.rows(), 3);
    skin.triangles << sheet.triangles, sheet.triangles.array() + static_cast<int>(half);
    mesh.skin_upper_margin.assign(2 * half, 0.01);
    std::fill(mesh.skin_upper_margin.begin() + half, mesh.skin_upper_margin.end(), -0.01);
    for (int k = 61; k <= 67; ++k)
      landmarks[face::ibug(k)] = {0.015 + 0.004 * (k < 64 ? k - 62 : 66 - k), 0, 0};
  }
  PointsF moved(const Points& skin) const { return (skin - mesh.skin.points).cast<float>(); }
  PointsF moved_by(const Vec3& by) const { return moved(lower_moved(by)); }
  Points lower_moved(const Vec3& by) const {
    Points skin = mesh.skin.points;
    skin.bottomRows(half).rowwise() += by.transpose();
    return skin;
  }
};

TEST(LipContact, IsNoneAtRestAndApart) {
  const FlatLips lips;
  const LipContact contact(lips.mesh, lips.landmarks);
  EXPECT_EQ(contact.depth(lips.moved(lips.mesh.skin.points)), 0);
  EXPECT_EQ(contact.depth(lips.moved_by({0, -0.005, 0})), 0) << "open";
  EXPECT_EQ(contact.depth(lips.moved_by({0, -0.005, -0.002})), 0) << "behind, but below the rim";
  EXPECT_EQ(contact.depth(lips.moved_by({0, 0.003, 0.001})), 0) << "in front of the upper lip";
}

TEST(LipContact, MeasuresDepthBehindTheUpperLip) {
  const FlatLips lips;
  const LipContact contact(lips.mesh, lips.landmarks);
  for (const double depth : {0.0005, 0.001, 0.004})
    EXPECT_NEAR(contact.depth(lips.moved_by({0.0001, 0.003, -depth})), depth, 1e-9);
  EXPECT_EQ(contact.depth(lips.moved_by({0.0001, 0.003, -0.008})), 0)
      << "that far behind is another part of the face";
}

TEST(LipContact, CountsFromRest) {
  FlatLips lips;  // scanned with the lower lip behind the upper one already
  lips.mesh.skin.points = lips.lower_moved({0.0001, 0.003, -0.0015});
  const LipContact contact(lips.mesh, lips.landmarks);
  EXPECT_EQ(contact.depth(lips.moved(lips.mesh.skin.points)), 0);
  EXPECT_NEAR(contact.depth(lips.moved_by({0, 0, -0.001})), 0.001, 1e-9);
  EXPECT_EQ(contact.depth(lips.moved_by({0, 0, 0.001})), 0)
      << "less than at rest is not less than none";
}

TEST(LipContact, NothingToMeasureWithoutLips) {
  FlatLips lips;
  for (auto& [name, p] : lips.landmarks) p += Vec3(1, 1, 1);
  const LipContact contact(lips.mesh, lips.landmarks);
  EXPECT_EQ(contact.depth(lips.moved_by({0, 0.003, -0.001})), 0);
}

}  // namespace
}  // namespace hyperex::reenact
