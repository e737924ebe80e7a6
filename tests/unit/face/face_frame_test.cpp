// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/face_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::face {
namespace {

io::Landmarks canonical_landmarks() {
  io::Landmarks landmarks;
  for (const auto& name : all_ibug())
    landmarks[name] = canonical_face().landmark(name, canonical_face().mesh.points);
  return landmarks;
}

TEST(FaceFrame, OfTheCanonicalFaceIsItsAxes) {
  const io::Landmarks landmarks = canonical_landmarks();
  const FaceFrame frame = face_frame(landmarks);
  EXPECT_GT(frame.x.x(), 0.999) << "to the subject's left";
  EXPECT_GT(frame.y.y(), 0.95) << "up";
  EXPECT_GT(frame.z.z(), 0.95) << "forward";
  EXPECT_LT((frame.origin - (landmarks.at(ibug(48)) + landmarks.at(ibug(54))) / 2).norm(), 1e-15);
}

TEST(FaceFrame, IsOrthonormalAndTurnsWithTheFace) {
  const io::Landmarks landmarks = canonical_landmarks();
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translate(Vec3(0.3, -0.2, 1)).rotate(Eigen::AngleAxisd(2, Vec3(1, 2, -1).normalized()));
  io::Landmarks turned;
  for (const auto& [name, p] : landmarks) turned[name] = turn * p;
  const FaceFrame a = face_frame(landmarks), b = face_frame(turned);
  Eigen::Matrix3d axes;
  axes << b.x, b.y, b.z;
  EXPECT_LT((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-14);
  EXPECT_NEAR(axes.determinant(), 1, 1e-14);
  for (const auto& [name, p] : landmarks) EXPECT_LT((a.local(p) - b.local(turn * p)).norm(), 1e-14);
}

TEST(FaceFrame, LocalAndWorldAreInverse) {
  const FaceFrame frame = face_frame(canonical_landmarks());
  const Vec3 p(0.01, 0.05, -0.03);
  EXPECT_LT((frame.world(frame.local(p)) - p).norm(), 1e-16);
  EXPECT_NEAR(frame.local(p).norm(), (p - frame.origin).norm(), 1e-15) << "lengths stay metres";
}

TEST(FaceFrame, NeedsItsLandmarks) {
  for (int k : {8, 27, 36, 45, 48, 54}) {
    io::Landmarks landmarks = canonical_landmarks();
    landmarks.erase(ibug(k));
    EXPECT_THROW(face_frame(landmarks), std::out_of_range) << k;
  }
}

// A synthetic face whose mouth is 1 cm in front of its eyes. The chin has no effect.
TEST(FaceFrame, OfCornersIsKnownByHand) {
  const io::Landmarks corners = {{"exocanthion_R", {-0.045, 0.03, 0}},
                                 {"exocanthion_L", {0.045, 0.03, 0}},
                                 {"cheilion_R", {-0.025, -0.03, 0.01}},
                                 {"cheilion_L", {0.025, -0.03, 0.01}}};
  const auto frame = face_frame_of_corners(corners);
  ASSERT_TRUE(frame);
  EXPECT_LT((frame->origin - Vec3(0, -0.03, 0.01)).norm(), 1e-15);
  EXPECT_LT((frame->x - Vec3(1, 0, 0)).norm(), 1e-15);
  EXPECT_LT((frame->y - Vec3(0, 6, -1).normalized()).norm(), 1e-14);
  EXPECT_LT((frame->z - Vec3(0, 1, 6).normalized()).norm(), 1e-14);
  const Eigen::Matrix3d face_from_scan = frame->face_from_scan();
  const Vec3 p(0.01, 0.02, 0.03);
  EXPECT_LT((face_from_scan * (p - frame->origin) - frame->local(p)).norm(), 1e-16);
}

TEST(FaceFrame, OfCornersKnowsBothNamesOfAPlace) {
  const io::Landmarks all = canonical_landmarks();  // iBUG names alone
  const auto frame = face_frame_of_corners(all);
  ASSERT_TRUE(frame);
  const FaceFrame whole = face_frame(all);
  EXPECT_LT((frame->origin - whole.origin).norm(), 1e-15);
  EXPECT_LT((frame->x - whole.x).norm(), 1e-15);
  const double lean_deg = std::acos(frame->y.dot(whole.y)) * 180 / M_PI;
  EXPECT_GT(lean_deg, 1);
  EXPECT_LT(lean_deg, 20);
}

TEST(FaceFrame, OfCornersIsNoneWithoutThem) {
  for (int k : {36, 45, 48, 54}) {
    io::Landmarks landmarks = canonical_landmarks();
    landmarks.erase(ibug(k));
    EXPECT_FALSE(face_frame_of_corners(landmarks)) << k;
  }
  const Vec3 one(0.1, 0.2, 0.3);
  EXPECT_FALSE(
      face_frame_of_corners({{ibug(36), one}, {ibug(45), one}, {ibug(48), one}, {ibug(54), one}}));
}

}  // namespace
}  // namespace hyperex::face
