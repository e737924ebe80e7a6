// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/asymmetry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/metrics/regions.hpp"
#include "unit/metrics/mirrored_face.hpp"

namespace hyperex::metrics {
namespace {
using testing::Face;

// A mirror-symmetric field: the component across is odd in x, those along are even.
PointsF mirrored_motion(const Points& rest) {
  PointsF u(rest.rows(), 3);
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const double x = rest(v, 0), y = rest(v, 1);
    u.row(v) << float(0.1 * x * std::cos(20 * y)), float(0.01 * std::cos(15 * x)),
        float(2 * x * x - 0.1 * y);
  }
  return u;
}

TEST(Asymmetry, OfAMirroredMotionIsZero) {
  const Face face = testing::mirrored_face();
  const std::vector<PointsF> frames = {mirrored_motion(face.mesh.points)};
  const Asymmetry all = asymmetry_of(rest_asymmetry(face.mesh, face.landmarks), frames);
  EXPECT_DOUBLE_EQ(all.paired_share, 1);
  EXPECT_LT(all.rest_rms_mm, 1e-6);
  EXPECT_LT(all.frames[0].face_rms_mm, 1e-4);
  EXPECT_LT(all.frames[0].mouth_p95_mm, 1e-4);
  EXPECT_LT(asymmetry_mm(all.plane, all.pairs, frames[0]).maxCoeff(), 1e-4);
}

// The left half is lifted by 4 mm: both halves then differ from their reflections by 4 mm.
TEST(Asymmetry, OfAOneSidedMotionIsItsLength) {
  for (const auto& pose : {Eigen::Isometry3d::Identity(), testing::some_pose()}) {
    Face face = testing::mirrored_face();
    const Points upright = face.mesh.points;
    const Regions regions = regions_of(upright, face.landmarks);
    testing::move(face, pose);
    const Vec3 lift = pose.linear() * Vec3(0.001, 0.0032, -0.00218174);  // 4 mm long
    PointsF u = PointsF::Zero(upright.rows(), 3);
    for (Eigen::Index v = 0; v < u.rows(); ++v)
      if (upright(v, 0) > 0.005) u.row(v) = lift.transpose().cast<float>();
    const Asymmetry all =
        asymmetry_of(rest_asymmetry(face.mesh, face.landmarks), {PointsF::Zero(u.rows(), 3), u});
    EXPECT_EQ(all.worst_frame, 1);
    EXPECT_LT(all.frames[0].face_rms_mm, 1e-9);
    const Eigen::VectorXf map = asymmetry_mm(all.plane, all.pairs, u);
    double squares = 0, count = 0;
    for (const int v : regions.find("face")->vertices) {
      const double expected = std::abs(upright(v, 0)) > 0.005 ? 4 : 0;
      EXPECT_NEAR(map[v], expected, 2e-3);
      squares += expected * expected;
      ++count;
    }
    EXPECT_NEAR(all.frames[1].face_rms_mm, std::sqrt(squares / count), 2e-3);
    EXPECT_NEAR(all.frames[1].face_p95_mm, 4, 2e-3);
  }
}

// A point that slides along the surface is detected, since corresponding points are compared, not
// surfaces.
TEST(Asymmetry, SeesWhatSlidesAcross) {
  const Face face = testing::mirrored_face();
  PointsF u = PointsF::Zero(face.mesh.points.rows(), 3);
  u.col(0).setConstant(0.002F);  // all to the left: the reflection goes right
  const Asymmetry all = asymmetry_of(rest_asymmetry(face.mesh, face.landmarks), {u});
  EXPECT_NEAR(all.frames[0].face_rms_mm, 4, 1e-3);
}

TEST(Asymmetry, AtRestIsTakenOut) {
  Face face = testing::mirrored_face(2);
  const Points upright = face.mesh.points;
  const Vec3 cheek = face.landmarks.at("cheek_L");
  for (Eigen::Index v = 0; v < upright.rows(); ++v) {
    const double far = (upright.row(v).transpose() - cheek).norm() / 0.02;
    face.mesh.points(v, 2) += 0.003 * std::exp(-far * far);
  }
  const Asymmetry all =
      asymmetry_of(rest_asymmetry(face.mesh, face.landmarks), {mirrored_motion(upright)});
  EXPECT_GT(all.rest_p95_mm, 0.5);
  EXPECT_LT(all.frames[0].face_rms_mm, 0.15);
}

// Two sheets, a tenth of a millimetre apart, that change places under reflection.
TEST(Asymmetry, ALipIsNotTakenForTheOther) {
  TriMesh two{Points(6, 3), Triangles(2, 3)};
  two.points << -0.02, 0, 0, 0.02, 0, 0, 0, 0.02, 0,  //
      -0.02, 0, -1e-4, 0.02, 0, 1e-4, 0, 0.02, 1e-4;
  two.triangles << 0, 1, 2, 3, 4, 5;
  const MidsagittalPlane plane;
  const auto sheet_of = [](const Counterparts& pairs, size_t v) {
    Eigen::Index k = 0;
    pairs.weights[v].maxCoeff(&k);
    return pairs.vertices[v][size_t(k)] / 3;
  };
  EXPECT_EQ(sheet_of(counterparts(two, plane), 3), 0);
  const Counterparts reported = counterparts(two, plane, {1, 1, 1, -1, -1, -1});
  for (size_t v = 0; v < 6; ++v) EXPECT_EQ(sheet_of(reported, v), int(v / 3));
}

TEST(Asymmetry, WhatHasNoCounterpartIsNoNumber) {
  Face face = testing::mirrored_face();
  // The left half's rim is cut away: triangles with a vertex beyond 4 cm to the left.
  std::vector<int> kept;
  for (int f = 0; f < face.mesh.triangles.rows(); ++f) {
    bool keep = true;
    for (int k = 0; k < 3; ++k) keep &= face.mesh.points(face.mesh.triangles(f, k), 0) < 0.04;
    if (keep) kept.push_back(f);
  }
  const Triangles cut = face.mesh.triangles(kept, Eigen::all);
  face.mesh.triangles = cut;
  const Asymmetry all = asymmetry_of(rest_asymmetry(face.mesh, face.landmarks),
                                     {PointsF::Zero(face.mesh.points.rows(), 3)});
  EXPECT_LT(all.paired_share, 0.95);
  const Eigen::VectorXf map =
      asymmetry_mm(all.plane, all.pairs, PointsF::Zero(face.mesh.points.rows(), 3));
  for (Eigen::Index v = 0; v < map.size(); ++v)
    if (face.mesh.points(v, 0) < -0.06) {
      EXPECT_TRUE(std::isnan(map[v])) << v;
    }
}

}  // namespace
}  // namespace hyperex::metrics
