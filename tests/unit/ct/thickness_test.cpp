// SPDX-License-Identifier: GPL-3.0-or-later
// Thickness on a CT made from two balls, where it is known.
#include "hyperex/ct/thickness.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hyperex/ct/ct_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "support/made_ct.hpp"

namespace hyperex::ct {
namespace {

constexpr double kSkin_mm = 46, kBone_mm = 36;
const Vec3 kBoneMiddle_mm(1.5, -2, 3);

test::MadeHead two_balls(double noise_hu = 30) {
  return {test::ball({0, 0, 0}, kSkin_mm), test::ball(kBoneMiddle_mm, kBone_mm), noise_hu};
}

CtFace balls_face(Volume volume) {
  SeriesVolume series;
  series.volume = std::move(volume);
  return face_of_series(std::move(series));
}

struct Errors {
  double mean_mm = 0, at_95_mm = 0;
  std::size_t count = 0;
};

Errors errors_of(std::vector<double> absolute_mm) {
  std::sort(absolute_mm.begin(), absolute_mm.end());
  const double sum = std::accumulate(absolute_mm.begin(), absolute_mm.end(), 0.0);
  return {sum / double(absolute_mm.size()),
          absolute_mm[std::size_t(0.95 * double(absolute_mm.size() - 1))], absolute_mm.size()};
}

/// Errors of both distances, at the place of the true skin that is nearest to each vertex.
std::pair<Errors, Errors> errors_of(const CtFace& face) {
  std::vector<double> shortest, along;
  for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v) {
    const Vec3 outward = Vec3(face.skin.points.row(v)).normalized(), at_mm = kSkin_mm * outward;
    const Vec3 from_middle = at_mm - kBoneMiddle_mm;
    if (!std::isnan(face.thickness.shortest_m[v]))
      shortest.push_back(
          std::abs(1e3 * face.thickness.shortest_m[v] - (from_middle.norm() - kBone_mm)));
    if (!std::isnan(face.thickness.along_normal_m[v])) {
      const double b = from_middle.dot(outward);
      const double truth = b - std::sqrt(b * b - from_middle.squaredNorm() + kBone_mm * kBone_mm);
      along.push_back(std::abs(1e3 * face.thickness.along_normal_m[v] - truth));
    }
  }
  return {errors_of(shortest), errors_of(along)};
}

void expect_close(const CtFace& face) {
  const auto [shortest, along] = errors_of(face);
  ASSERT_GT(shortest.count, 1000u);
  ASSERT_GT(along.count, 1000u);
  testing::Test::RecordProperty("shortest_mean_mm", std::to_string(shortest.mean_mm));
  std::cout << "  shortest: mean " << shortest.mean_mm << ", 95 % " << shortest.at_95_mm
            << " mm; along the normal: mean " << along.mean_mm << ", 95 % " << along.at_95_mm
            << " mm\n";
  EXPECT_LT(shortest.mean_mm, 0.5);
  EXPECT_LT(shortest.at_95_mm, 1.5);
  EXPECT_LT(along.mean_mm, 0.5);
  EXPECT_LT(along.at_95_mm, 1.5);
}

/// The changes (mm) of the shortest distance at the places of `face`'s vertices, rising.
std::vector<double> changes_mm(const CtFace& face, const CtFace& other) {
  const SurfaceTree tree(other.skin);
  std::vector<double> out;
  for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v) {
    if (std::isnan(face.thickness.shortest_m[v])) continue;
    const ClosestPoint near = tree.query(face.skin.points.row(v).transpose());
    double value = 0;
    for (int k = 0; k < 3; ++k)
      value += near.weights[k] * other.thickness.shortest_m[other.skin.triangles(near.triangle, k)];
    if (!std::isnan(value)) out.push_back(1e3 * std::abs(value - face.thickness.shortest_m[v]));
  }
  std::sort(out.begin(), out.end());
  std::cout << "  change: median " << out[out.size() / 2] << ", 95 % " << out[out.size() * 95 / 100]
            << ", 99.9 % " << out[out.size() * 999 / 1000] << ", greatest " << out.back()
            << " mm of " << out.size() << '\n';
  return out;
}

Volume of(const Vec3& spacing_mm, const Eigen::Matrix3d& turn = Eigen::Matrix3d::Identity(),
          double size_mm = 108) {
  return test::volume_of(two_balls(), {0, 0, 0}, Vec3::Constant(size_mm), spacing_mm, turn);
}

TEST(Thickness, OfVoxelsOfHalfAMillimetre) {
  expect_close(balls_face(of({0.5, 0.5, 0.5})));
}

TEST(Thickness, OfVoxelsOfTwoMillimetres) {
  expect_close(balls_face(of({2, 2, 2})));
}

TEST(Thickness, IsTheSameForATurnedVolume) {
  const CtFace face = balls_face(of({1, 1, 1}));
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.5, Vec3(1, 2, 0.5).normalized()).matrix();
  const CtFace turned = balls_face(of({1, 1, 1}, turn, 130));
  expect_close(turned);
  EXPECT_LT(changes_mm(face, turned).back(), 0.5);
}

TEST(Thickness, IsTheSameResampledToOneAndAHalfMillimetres) {
  const Volume fine = of({0.75, 0.75, 0.75});
  Volume coarse = of({1.5, 1.5, 1.5}, Eigen::Matrix3d::Identity(), 105);
  for (int k = 0; k < coarse.size[2]; ++k)
    for (int j = 0; j < coarse.size[1]; ++j)
      for (int i = 0; i < coarse.size[0]; ++i) {
        // The mean of eight places within the voxel, as a resampler that does not alias takes.
        double sum = 0;
        for (int n = 0; n < 8; ++n)
          sum += fine.sample(coarse.place(i + ((n & 1) - 0.5) / 2, j + ((n >> 1 & 1) - 0.5) / 2,
                                          k + ((n >> 2) - 0.5) / 2));
        coarse.hu[coarse.at(i, j, k)] = float(sum / 8);
      }
  const CtFace face = balls_face(fine), resampled = balls_face(coarse);
  expect_close(resampled);
  EXPECT_LT(changes_mm(face, resampled).back(), 0.5);
}

TEST(Thickness, IsNoneBehindTheBoundsAndBelowTheJaw) {
  const CtFace face = balls_face(of({2, 2, 2}));
  FaceBounds bounds;
  bounds.back_z_m = -0.01, bounds.chin_z_m = 0.03, bounds.chin_y_m = -0.03, bounds.rise = 0.2;
  const Thickness some = measure_thickness(face.skin, face.bones.skull, bounds, {});
  int inside = 0;
  for (Eigen::Index v = 0; v < face.skin.points.rows(); ++v) {
    const Vec3 p = face.skin.points.row(v);
    const bool is_face = p.z() >= -0.01 && p.y() >= -0.03 + 0.2 * (0.03 - p.z());
    ASSERT_EQ(std::isnan(some.shortest_m[v]), !is_face);
    inside += is_face ? 1 : 0;
  }
  EXPECT_GT(inside, 100);
}

TEST(Thickness, AlongTheNormalIsNoneWhereTheBoneIsMissed) {
  TriMesh skin{Points(3, 3), Triangles(1, 3)}, bone = skin;
  skin.points << 0, 0, 0, 0.01, 0, 0, 0, 0.01, 0;
  skin.triangles << 0, 1, 2;
  bone.points << -0.001, -0.001, -0.004, 0.002, -0.001, -0.004, -0.001, 0.002, -0.004;
  bone.triangles = skin.triangles;
  FaceBounds all;
  all.back_z_m = all.chin_y_m = -1;
  const Thickness some = measure_thickness(skin, bone, all, {});
  EXPECT_NEAR(some.shortest_m[0], 0.004, 1e-7);
  EXPECT_NEAR(some.along_normal_m[0], 0.004, 1e-7);
  EXPECT_TRUE(std::isnan(some.along_normal_m[1]));
  EXPECT_NEAR(some.shortest_m[1], std::sqrt(0.008 * 0.008 + 0.001 * 0.001 + 0.004 * 0.004), 1e-4);
}

TEST(Thickness, WithoutAPogonionLipsAndChinAreNoCheeks) {
  TriMesh skin{Points(6, 3), Triangles(2, 3)}, bone{Points(3, 3), Triangles(1, 3)};
  // Below the nose: in the middle, at the lips' end, beside them; above it: a cheek.
  skin.points << 0, -0.02, 0.05, 0.029, -0.06, 0.05, 0.031, -0.06, 0.05, 0.04, 0, 0.05, -0.04, 0,
      0.05, 0, 0.05, 0.05;
  skin.triangles << 0, 1, 2, 3, 5, 4;
  bone.points << -0.1, -0.1, 0.04, 0.1, -0.1, 0.04, 0, 0.2, 0.04;
  bone.triangles << 0, 1, 2;
  FoundPoints points;
  points.skin["pronasale"] = Vec3(0, 0, 0.06);
  FaceBounds bounds;
  bounds.back_z_m = -1, bounds.chin_y_m = -1;
  const Thickness found = measure_thickness(skin, bone, bounds, points);
  const std::vector<Region> wanted = {Region::none,       Region::none,        Region::cheek_left,
                                      Region::cheek_left, Region::cheek_right, Region::forehead};
  EXPECT_EQ(found.region, wanted);
}

}  // namespace
}  // namespace hyperex::ct
