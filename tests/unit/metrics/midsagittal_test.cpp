// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/midsagittal.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/core/error.hpp"
#include "hyperex/face/optional_landmarks.hpp"
#include "unit/metrics/mirrored_face.hpp"

namespace hyperex::metrics {
namespace {
using testing::Face;

double degrees_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) * 180 / M_PI;
}

TEST(Midsagittal, IsExactForAMirroredFaceHoweverItIsTurned) {
  for (const auto& pose : {Eigen::Isometry3d::Identity(), testing::some_pose()}) {
    Face face = testing::mirrored_face();
    testing::move(face, pose);
    const MidsagittalPlane plane = midsagittal_plane(face.mesh, face.landmarks);
    EXPECT_LT(degrees_between(plane.normal, pose.linear() * Vec3::UnitX()), 1e-6);
    EXPECT_NEAR(plane.offset_m, plane.normal.dot(pose.translation()), 1e-9);
    EXPECT_LT(plane.surface_rms_m, 1e-9);
    EXPECT_GT(plane.rounds, 0);
    EXPECT_TRUE(plane.note.empty());
  }
}

// With 0.3 mm of noise on every coordinate of the surface and 1 mm on the landmarks', the plane
// stays within 0.15 degrees and 0.1 mm: the surface corrects the errors of the landmarks.
TEST(Midsagittal, StandsNoiseOnSurfaceAndLandmarks) {
  double worst_deg = 0, worst_mm = 0, landmarks_deg = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Face face = testing::mirrored_face(2);
    const Eigen::Isometry3d pose = testing::some_pose();
    testing::move(face, pose);
    const Vec3 middle = face.mesh.points.colwise().mean();
    const Vec3 normal = pose.linear() * Vec3::UnitX();
    std::mt19937 generator(seed);
    testing::roughen(face.mesh.points, 3e-4, generator);
    std::normal_distribution<double> noise(0, 1e-3);
    for (auto& [name, p] : face.landmarks)
      p += Vec3(noise(generator), noise(generator), noise(generator));
    const MidsagittalPlane plane = midsagittal_plane(face.mesh, face.landmarks);
    worst_deg = std::max(worst_deg, degrees_between(plane.normal, normal));
    const double away =
        (plane.normal.dot(middle) - plane.offset_m) - normal.dot(middle - pose.translation());
    worst_mm = std::max(worst_mm, 1e3 * std::abs(away));
    landmarks_deg =
        std::max(landmarks_deg, degrees_between(landmark_plane(face.landmarks).normal, normal));
  }
  std::cout << "plane: " << worst_deg << " degrees, " << worst_mm << " mm at most; landmarks alone "
            << landmarks_deg << " degrees\n";
  EXPECT_LT(worst_deg, 0.15);
  EXPECT_LT(worst_mm, 0.1);
  EXPECT_LT(worst_deg, landmarks_deg);
}

// A swelling of one cheek by 8 mm hardly rotates the plane, since its vertices get small weights.
TEST(Midsagittal, ASwollenCheekHardlyTurnsIt) {
  Face face = testing::mirrored_face(2);
  const Vec3 cheek = face.landmarks.at("cheek_L");
  for (Eigen::Index v = 0; v < face.mesh.points.rows(); ++v) {
    const double far = (face.mesh.points.row(v).transpose() - cheek).norm() / 0.02;
    face.mesh.points(v, 2) += 0.008 * std::exp(-far * far);
  }
  const MidsagittalPlane plane = midsagittal_plane(face.mesh, face.landmarks);
  EXPECT_LT(degrees_between(plane.normal, Vec3::UnitX()), 0.5);
  EXPECT_LT(std::abs(plane.offset_m), 5e-4);
}

TEST(Midsagittal, ABadLandmarkCountsLittle) {
  Face face = testing::mirrored_face();
  face.landmarks.at("ibug68_4") += Vec3(0.03, 0.02, 0);
  EXPECT_LT(degrees_between(landmark_plane(face.landmarks).normal, Vec3::UnitX()), 0.3);
}

// A fold may have its place on one side alone.
TEST(Midsagittal, LandmarksOfTheFoldsDoNotCount) {
  Face face = testing::mirrored_face();
  const MidsagittalPlane before = landmark_plane(face.landmarks);
  for (const std::string& name : face::optional_landmarks())
    face.landmarks[name] = face.landmarks.at("cheek_L") + Vec3(0, 0.01, 0);
  const MidsagittalPlane after = landmark_plane(face.landmarks);
  EXPECT_EQ(after.normal, before.normal);
  EXPECT_EQ(after.offset_m, before.offset_m);
}

TEST(Midsagittal, ASurfaceOfOneSideLeavesItToTheLandmarks) {
  const Face face = testing::mirrored_face();
  TriMesh right{face.mesh.points, Triangles(0, 3)};
  for (const auto& triangle : face.mesh.triangles.rowwise())
    if (face.mesh.points(triangle[0], 0) < -0.01) {
      right.triangles.conservativeResize(right.triangles.rows() + 1, 3);
      right.triangles.bottomRows(1) = triangle;
    }
  ASSERT_GT(right.triangles.rows(), 0);
  const MidsagittalPlane plane = midsagittal_plane(right, face.landmarks);
  EXPECT_FALSE(plane.note.empty());
  EXPECT_LT(degrees_between(plane.normal, Vec3::UnitX()), 1e-6);
}

TEST(Midsagittal, RefusesTooFewPairs) {
  Face face = testing::mirrored_face();
  io::Landmarks few = {{"cheilion_L", face.landmarks.at("cheilion_L")},
                       {"cheilion_R", face.landmarks.at("cheilion_R")},
                       {"pronasale", face.landmarks.at("pronasale")}};
  EXPECT_THROW(landmark_plane(few), InputError);
  few["alare_L"] = face.landmarks.at("alare_L");
  few["alare_R"] = face.landmarks.at("alare_R");
  EXPECT_LT(degrees_between(landmark_plane(few).normal, Vec3::UnitX()), 1e-6);
}

}  // namespace
}  // namespace hyperex::metrics
