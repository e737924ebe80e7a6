// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/face_frame.hpp"

#include <gtest/gtest.h>

#include <set>
#include <stdexcept>

#include "hyperex/geometry/transform.hpp"
#include "hyperex/tissue/canonical_face.hpp"

namespace hyperex::tissue {
namespace {

io::Landmarks canonical_landmarks() {
  io::Landmarks landmarks;
  for (const auto& name : all_ibug())
    landmarks[name] = canonical_face().landmark(name, canonical_face().mesh.points);
  return landmarks;
}

TEST(Names, AreTheSixtyEight) {
  EXPECT_EQ(ibug(48), "ibug68_48");
  EXPECT_EQ(std::set<std::string>(all_ibug().begin(), all_ibug().end()).size(), 68u);
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

}  // namespace
}  // namespace hyperex::tissue
