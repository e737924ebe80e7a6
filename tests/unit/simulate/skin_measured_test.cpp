// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/skin_measured.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

using face::ibug;

class Region : public testing::Test {
 protected:
  const test::SmallFace face_ = test::small_face();
  AlignedMotion motion_ =
      test::motion_of(face_.landmarks, 1, 30, [](auto&, auto&, int) { return Vec3::Zero(); });
  RegionOptions options_;
  MeasuredRegion region() const {
    return measured_region(face_.mesh, face_.landmarks, motion_, options_);
  }
};

TEST_F(Region, NoneIsAllPhysical) {
  const MeasuredRegion r = region();
  EXPECT_THAT(r.share, testing::Each(0));
  EXPECT_THAT(r.outer_share, testing::Each(0));
  EXPECT_EQ(r.share.size(), face_.mesh.skin_upper_margin.size());
  EXPECT_TRUE(r.skin.empty());
}

TEST_F(Region, AllIsAllMeasuredAndLipsNeverCross) {
  options_.measured = Measured::all;
  const MeasuredRegion r = region();
  EXPECT_THAT(r.share, testing::Each(1));
  EXPECT_THAT(r.outer_share, testing::Each(1));
  ASSERT_EQ(r.skin.size(), r.share.size());
  const Points& skin = face_.mesh.skin.points;
  int lips = 0;
  for (std::size_t v = 0; v < r.skin.size(); ++v) {
    EXPECT_NEAR(r.skin[v].weight.sum(), 1, 1e-12);
    const double margin = face_.mesh.skin_upper_margin[v];
    bool near = false;
    for (int k = 48; k < 68; ++k)
      near |= (skin.row(v).transpose() - face_.landmarks.at(ibug(k))).norm() < 0.008;
    if (!near || std::abs(margin) < 0.005) continue;
    ++lips;
    for (int k = 0; k < 3; ++k)
      EXPECT_GE(anatomy::lip_of(motion_.motion.names[r.skin[v].point[k]]) * margin, 0);
  }
  EXPECT_GT(lips, 20);
}

TEST_F(Region, AroundPointsBlendsOut) {
  options_.measured = Measured::points;
  options_.measured_points = {ibug(8), ibug(57)};
  options_.measured_radius_m = 0.012;
  options_.blend_m = 0.01;
  const MeasuredRegion r = region();
  const Points& skin = face_.mesh.skin.points;
  int inside = 0, between = 0;
  std::vector<std::pair<double, double>> by_distance;
  for (Eigen::Index v = 0; v < skin.rows(); ++v) {
    double d = 1;
    for (const auto& name : options_.measured_points)
      d = std::min(d, (skin.row(v).transpose() - face_.landmarks.at(name)).norm());
    if (d <= 0.012) {
      EXPECT_EQ(r.share[v], 1);
      ++inside;
    }
    if (d >= 0.022) {
      EXPECT_EQ(r.share[v], 0);
    }
    if (d > 0.012 && d < 0.022) {
      EXPECT_GT(r.share[v], 0);
      EXPECT_LT(r.share[v], 1);
      ++between;
    }
    by_distance.push_back({d, r.share[v]});
    EXPECT_EQ(r.outer_share[v], r.share[v]) << "skin and outer nodes are the same here";
  }
  EXPECT_GT(inside, 3);
  EXPECT_GT(between, 3);
  std::sort(by_distance.begin(), by_distance.end());
  for (std::size_t i = 0; i + 1 < by_distance.size(); ++i)
    EXPECT_GE(by_distance[i].second, by_distance[i + 1].second) << "falls with distance";
}

TEST_F(Region, TheMotionsOwnTrianglesAreUsed) {
  options_.measured = Measured::all;
  motion_.motion.triangles.resize(1, 3);
  motion_.motion.triangles << motion_.motion.index_of(ibug(0)), motion_.motion.index_of(ibug(8)),
      motion_.motion.index_of(ibug(16));
  for (const Match& m : region().skin)
    EXPECT_THAT(m.point, testing::ElementsAreArray(motion_.motion.triangles.row(0)));
}

TEST_F(Region, LipsOfAMeshWithoutNamesNeverCross) {
  options_.measured = Measured::all;
  const Points& skin = face_.mesh.skin.points;
  // The skin itself, tracked with its lips a little too high: the nearest point of an upper lip's
  // vertex is then one of the lower lip.
  motion_.motion.names.clear();
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    motion_.motion.names.push_back("vertex_" + std::to_string(v));
  motion_.motion.triangles = face_.mesh.skin.triangles;
  motion_.rest = skin.rowwise() + Eigen::RowVector3d(0, 0.004, 0);
  const MeasuredRegion r = region();
  int lips = 0;
  for (std::size_t v = 0; v < r.skin.size(); ++v) {
    const double margin = face_.mesh.skin_upper_margin[v];
    bool near = false;
    for (int k = 48; k < 68; ++k)
      near |= (skin.row(Eigen::Index(v)).transpose() - face_.landmarks.at(ibug(k))).norm() < 0.008;
    if (!near || std::abs(margin) < 0.005) continue;
    ++lips;
    for (int k = 0; k < 3; ++k)
      if (r.skin[v].weight[k] > 0.01) {
        const double other = face_.mesh.skin_upper_margin[std::size_t(r.skin[v].point[k])];
        EXPECT_FALSE(std::abs(other) > 0.005 && other * margin < 0) << v;
      }
  }
  EXPECT_GT(lips, 20);
}

TEST_F(Region, RefusesUnknownNamesAndTooFewPoints) {
  options_.measured = Measured::points;
  options_.measured_points = {"nobody"};
  EXPECT_THAT(hyperex::test::refusal([&] { region(); }), testing::HasSubstr("nobody"));
  const AlignedMotion two = test::motion_of({{"a", {0, 0, 0}}, {"b", {0.1, 0, 0}}}, 1, 30,
                                            [](auto&, auto&, int) { return Vec3::Zero(); });
  options_.measured = Measured::all;
  options_.measured_points.clear();
  EXPECT_THROW(measured_region(face_.mesh, face_.landmarks, two, options_), InputError);
}

}  // namespace
}  // namespace hyperex::simulate
