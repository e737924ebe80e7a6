// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/bone_depth.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/tissue/mesh/volume_mesh.hpp"

namespace hyperex::tissue {
namespace {

/// A flat skin of 60 x 60 mm in z = 0, and bone in z = -depth where x lies between two bounds.
constexpr double kHalf_m = 0.03;

TriMesh flat(double z, double from_x, double to_x, int cells) {
  TriMesh out{Points((cells + 1) * (cells + 1), 3), Triangles(2 * cells * cells, 3)};
  for (int j = 0; j <= cells; ++j)
    for (int i = 0; i <= cells; ++i)
      out.points.row(j * (cells + 1) + i) << from_x + (to_x - from_x) * i / cells,
          -kHalf_m + 2 * kHalf_m * j / cells, z;
  int f = 0;
  for (int j = 0; j < cells; ++j)
    for (int i = 0; i < cells; ++i) {
      const int a = j * (cells + 1) + i, b = a + 1, c = a + cells + 1, d = c + 1;
      out.triangles.row(f++) << a, b, d;
      out.triangles.row(f++) << a, d, c;
    }
  return out;
}

const TriMesh kSkin = flat(0, -kHalf_m, kHalf_m, 20);

Eigen::VectorXd depths(const anatomy::Bones& bones, double without_bone) {
  const Points inward = Points::Zero(kSkin.points.rows(), 3).rowwise() -
                        Eigen::RowVector3d(0, 0, 0.5);  // of any length
  return bone_depths(kSkin, inward, Eigen::VectorXd::Constant(inward.rows(), without_bone), bones);
}

TEST(BoneDepth, EndsOnTheBone) {
  const anatomy::Bones bones(flat(-0.009, -0.04, 0.04, 3), {});
  const Eigen::VectorXd depth = depths(bones, 0.012);
  EXPECT_NEAR(depth.minCoeff(), 0.009, 1e-7);
  EXPECT_NEAR(depth.maxCoeff(), 0.009, 1e-7);
}

TEST(BoneDepth, IsThatOfTheTableWhereBoneIsTooDeepOrThereIsNone) {
  const anatomy::Bones deep(flat(-0.025, -0.04, 0.04, 3), {});
  EXPECT_EQ((depths(deep, 0.012).array() - 0.012).abs().maxCoeff(), 0);
  const anatomy::Bones half(flat(-0.008, -0.04, 0, 3), {});
  const Eigen::VectorXd depth = depths(half, 0.012);
  for (Eigen::Index v = 0; v < depth.size(); ++v) {
    const double x = kSkin.points(v, 0);
    if (x < 0) {
      EXPECT_NEAR(depth[v], 0.008, 1e-7) << x;
    }
    if (x > 0.027) {
      EXPECT_GT(depth[v], 0.0105) << "nearly that of the table: " << x;
    }
    EXPECT_LT(depth[v], 0.012 + 1e-9);
  }
}

TEST(BoneDepth, GrowsByHalfOfTheWayAtMost) {
  // A hollow of 18 mm beside bone at 4 mm, as beside the rim of the orbit.
  TriMesh bone = flat(-0.004, -0.04, 0, 3);
  const TriMesh hollow = flat(-0.018, 0, 0.04, 3);
  const Eigen::Index points = bone.points.rows(), triangles = bone.triangles.rows();
  bone.points.conservativeResize(points + hollow.points.rows(), 3);
  bone.points.bottomRows(hollow.points.rows()) = hollow.points;
  bone.triangles.conservativeResize(triangles + hollow.triangles.rows(), 3);
  bone.triangles.bottomRows(hollow.triangles.rows()) = hollow.triangles.array() + int(points);
  const Eigen::VectorXd depth = depths(anatomy::Bones(bone, {}), 0.012);
  for (Eigen::Index f = 0; f < kSkin.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const int a = kSkin.triangles(f, k), b = kSkin.triangles(f, (k + 1) % 3);
      EXPECT_LE(std::abs(depth[a] - depth[b]),
                0.5 * (kSkin.points.row(a) - kSkin.points.row(b)).norm() + 1e-9);
    }
  EXPECT_NEAR(depth[10 * 21 + 20], 0.018, 1e-6) << "far from the step, the bone itself";
}

TEST(BoneDepth, ALayerOverBoneIsThatOfTheSameThickness) {
  const anatomy::Bones bones(flat(-0.009, -0.04, 0.04, 3), {});
  const Eigen::VectorXd table = Eigen::VectorXd::Constant(kSkin.points.rows(), 0.012);
  const VolumeMesh over_bone = build_volume_mesh(kSkin, table, {.bones = &bones});
  const VolumeMesh plain = build_volume_mesh(kSkin, 0.75 * table);
  EXPECT_EQ(over_bone.tets, plain.tets);
  EXPECT_LT((over_bone.nodes - plain.nodes).cwiseAbs().maxCoeff(), 1e-8);
}

}  // namespace
}  // namespace hyperex::tissue
