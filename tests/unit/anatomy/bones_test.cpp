// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/bones.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "hyperex/anatomy/align_surfaces.hpp"
#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/io/scan.hpp"

namespace hyperex::anatomy {
namespace {

/// A square in the plane z = height_m, 2 `half_m` wide about (x_m, 0).
TriMesh square(double height_m, double half_m, double x_m = 0) {
  TriMesh out{Points(4, 3), Triangles(2, 3)};
  out.points << x_m - half_m, -half_m, height_m, x_m + half_m, -half_m, height_m, x_m + half_m,
      half_m, height_m, x_m - half_m, half_m, height_m;
  out.triangles << 0, 1, 2, 0, 2, 3;
  return out;
}

Points moved(const Eigen::Isometry3d& by, const Points& points) {
  return (points * by.linear().transpose()).rowwise() + by.translation().transpose();
}

TEST(Bones, GiveTheNearestBoneAndTheFirstAlongARay) {
  const Bones bones(square(0, 0.05), square(-0.01, 0.05, 0.08));
  EXPECT_EQ(bones.nearest({0, 0, 0.003}, 0.01).bone, Bone::skull);
  EXPECT_NEAR(bones.nearest({0, 0, 0.003}, 0.01).distance_m, 0.003, 1e-9);
  EXPECT_EQ(bones.nearest({0, 0, 0.02}, 0.01).bone, Bone::none);
  EXPECT_EQ(bones.nearest({0.08, 0, -0.008}, 0.01).bone, Bone::mandible);
  EXPECT_EQ(bones.nearest(Bone::mandible, {0, 0, 0.003}, 0.01).bone, Bone::none);
  EXPECT_NEAR(bones.along({0, 0, 0.02}, -Vec3::UnitZ(), 0.03), 0.02, 1e-6);
  EXPECT_NEAR(bones.along({0.1, 0, 0.02}, -Vec3::UnitZ(), 0.04), 0.03, 1e-6);
  EXPECT_TRUE(std::isinf(bones.along({0, 0, 0.02}, -Vec3::UnitZ(), 0.01)));
  EXPECT_TRUE(std::isinf(bones.along({0, 0, 0.02}, Vec3::UnitZ(), 0.03)));
  EXPECT_THROW(Bones({}, {}), std::invalid_argument);
}

TEST(Bones, HeadsOfASculptedMandible) {
  const std::filesystem::path folder =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/bodyparts3d";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data";
  TriMesh mandible = io::read_mesh(folder / "mandible.stl", io::LengthUnit::millimetre);
  // The file has -y to the front and z up.
  const face::FaceFrame frame{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitZ(), -Vec3::UnitY()};
  Vec3 low = mandible.points.colwise().minCoeff(), high = mandible.points.colwise().maxCoeff();
  const Vec3 about(0.5 * (low.x() + high.x()), high.y() - 0.01, high.z() - 0.01);
  const auto condyles = find_condyles(mandible, frame, about);
  ASSERT_TRUE(condyles);
  const Vec3 left = (*condyles)[0], right = (*condyles)[1];
  EXPECT_GT(left.x(), right.x());
  // Heads of the mandible are 90 to 110 mm apart; this model is about 6 % small.
  EXPECT_GT((left - right).norm(), 0.08);
  EXPECT_LT((left - right).norm(), 0.11);
  EXPECT_NEAR(left.y(), right.y(), 0.004);
  EXPECT_NEAR(left.z(), right.z(), 0.004);
  EXPECT_LT(high.z() - left.z(), 0.012) << "near the top";
  // A chin alone has none.
  TriMesh chin = mandible;
  std::vector<int> kept;
  for (int f = 0; f < mandible.triangles.rows(); ++f)
    if (mandible.points(mandible.triangles(f, 0), 1) < low.y() + 0.03) kept.push_back(f);
  Points points(3 * Eigen::Index(kept.size()), 3);
  Triangles triangles(Eigen::Index(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      points.row(3 * Eigen::Index(i) + k) = mandible.points.row(mandible.triangles(kept[i], k));
      triangles(Eigen::Index(i), k) = 3 * int(i) + k;
    }
  EXPECT_FALSE(find_condyles({points, triangles}, frame, about));
}

TEST(AlignToSurface, FindsARigidMotionInSpiteOfPartsThatMoved) {
  const EmbeddedFace& face = embedded_face();
  Eigen::Isometry3d truth = Eigen::Isometry3d::Identity();
  truth.linear() = Eigen::AngleAxisd(0.12, Vec3(1, 2, 0.5).normalized()).toRotationMatrix();
  truth.translation() = Vec3(0.004, -0.006, 0.003);
  Points points = moved(truth.inverse(), face.mesh.points);
  // A tenth of the points is elsewhere, as lips in another expression.
  for (Eigen::Index v = 0; v < points.rows(); v += 10)
    points.row(v) += Eigen::RowVector3d(0, 0, 0.008);
  const SurfaceAlignment found = align_to_surface(points, face.mesh, Eigen::Isometry3d::Identity());
  EXPECT_LT((found.to_from_points.matrix() - truth.matrix()).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT(found.median_m, 1e-5);
  EXPECT_GT(found.p95_m, 0.002) << "points that are left out count in the distances";
}

}  // namespace
}  // namespace hyperex::anatomy
