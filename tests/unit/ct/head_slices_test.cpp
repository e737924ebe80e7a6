// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/head_slices.hpp"

#include <gtest/gtest.h>

#include <array>

namespace hyperex::ct {
namespace {

/// A box of 40 mm of soft tissue about the origin, in air, without bones.
struct Box {
  static constexpr double kHalf_m = 0.02;
  static constexpr int kCount = 61;
  Volume volume;
  TriMesh skin;
  BoneSurfaces bones;

  /// `bright`: a place (m) with a ball of metal of 4 mm.
  explicit Box(const Vec3& bright) {
    volume.size = {kCount, kCount, kCount};
    volume.step_m = 1e-3 * Eigen::Matrix3d::Identity();
    volume.origin_m = Vec3::Constant(-0.03);
    volume.hu.assign(volume.count(), -1000);
    for (int k = 0; k < kCount; ++k)
      for (int j = 0; j < kCount; ++j)
        for (int i = 0; i < kCount; ++i) {
          const Vec3 p = volume.place(i, j, k);
          if (p.cwiseAbs().maxCoeff() < kHalf_m) volume.hu[volume.at(i, j, k)] = -400;
          if ((p - bright).norm() < 4e-3) volume.hu[volume.at(i, j, k)] = 3000;
        }
    skin.points.resize(4, 3);
    skin.points << 1, 1, 1, -1, -1, 1, -1, 1, -1, 1, -1, -1;
    skin.points *= kHalf_m;
    skin.triangles.resize(4, 3);
    skin.triangles << 0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3;
  }
};

/// Where the brightest part of a picture lies: -1 left or low, 0 in the middle, 1 right or high.
std::array<int, 2> bright_side(const render::Image& image) {
  double x = 0, y = 0, count = 0;
  for (int row = 40; row < image.height; ++row)  // below the letters
    for (int column = 0; column < image.width; ++column) {
      const std::uint8_t* pixel = image.pixel(column, row);
      if (pixel[0] < 250 || pixel[1] < 250 || pixel[2] < 250) continue;
      x += column, y += row, ++count;
    }
  if (count == 0) return {-2, -2};
  const auto side = [](double share) { return share < 0.4 ? -1 : share > 0.6 ? 1 : 0; };
  return {side(x / count / image.width), side(1 - y / count / image.height)};
}

TEST(HeadSlices, AreSeenAsRadiologistsDo) {
  const auto slice = [](const Vec3& bright, int axis) {
    const Box box(bright);
    return bright_side(HeadSlices(box.volume, box.skin, box.bones).picture(axis, bright[axis]));
  };
  using Sides = std::array<int, 2>;
  // The subject's left is on the right of axial and coronal slices, its front above and at the
  // right of sagittal ones.
  EXPECT_EQ(slice({0.012, 0, 0}, 1), (Sides{1, 0}));
  EXPECT_EQ(slice({0.012, 0, 0}, 2), (Sides{1, 0}));
  EXPECT_EQ(slice({0, 0, 0.012}, 1), (Sides{0, 1}));
  EXPECT_EQ(slice({0, 0, 0.012}, 0), (Sides{1, 0}));
  EXPECT_EQ(slice({0, -0.012, 0}, 2), (Sides{0, -1}));
  EXPECT_EQ(slice({0, -0.012, 0}, 0), (Sides{0, -1}));
}

TEST(HeadSlices, LieBetweenTheEndsOfTheSkin) {
  const Box box({0, 0, 0.012});
  const HeadSlices slices(box.volume, box.skin, box.bones);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_DOUBLE_EQ(slices.low_m(axis), -Box::kHalf_m);
    EXPECT_DOUBLE_EQ(slices.high_m(axis), Box::kHalf_m);
  }
  EXPECT_EQ(bright_side(slices.picture(2, -0.012))[0], -2) << "the ball is elsewhere";
  EXPECT_EQ(HeadSlices::caption(1, 0.3021), "axial, y = 302 mm, from below");
  EXPECT_EQ(HeadSlices::caption(0, -2e-4), "sagittal, x = 0 mm, front at the right");
}

}  // namespace
}  // namespace hyperex::ct
