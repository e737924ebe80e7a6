// SPDX-License-Identifier: GPL-3.0-or-later
// The second face is a valid face that differs from the first; the flawed scan has exactly the
// stated faults.
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "hyperex/core/quantile.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/sample/bumps.hpp"
#include "hyperex/sample/flawed_scan.hpp"
#include "hyperex/sample/second_face.hpp"

namespace hyperex::sample {
namespace {

Vec3 normal(const TriMesh& mesh, Eigen::Index t) {
  const Vec3 a = mesh.points.row(mesh.triangles(t, 0)), b = mesh.points.row(mesh.triangles(t, 1)),
             c = mesh.points.row(mesh.triangles(t, 2));
  return (b - a).cross(c - a);
}

TEST(Bumps, HaveTheirShiftAtTheLandmarkAndFadeAsAGaussian) {
  const io::Landmarks landmarks = {{"here", {0.01, 0, 0}}};
  Points places(3, 3);
  places << 0.01, 0, 0, 0.01, 0.005, 0, 0.01, 0, 0.1;
  const Points moved =
      displacement({{"here", {1, 2, 3}, 5}, {"here", {1, 0, 0}, 5}}, landmarks, places);
  EXPECT_NEAR((moved.row(0) - Eigen::RowVector3d(0.002, 0.002, 0.003)).norm(), 0, 1e-15);
  EXPECT_NEAR((moved.row(1) - std::exp(-0.5) * moved.row(0)).norm(), 0, 1e-15);
  EXPECT_LT(moved.row(2).norm(), 1e-12);
  EXPECT_THROW(displacement({{"there", {1, 0, 0}}}, landmarks, places), std::out_of_range);
}

TEST(SecondFace, IsAnotherFaceWithTheSameTriangles) {
  const anatomy::EmbeddedFace first = anatomy::embedded_face(), second = second_face();
  ASSERT_EQ(second.mesh.triangles, first.mesh.triangles);
  const Eigen::VectorXd moved = (second.mesh.points - first.mesh.points).rowwise().norm();
  EXPECT_GT(moved.mean(), 0.002);
  EXPECT_LT(moved.maxCoeff(), 0.015);
  const auto between = [](const anatomy::EmbeddedFace& face, const char* a, const char* b) {
    return (face.landmarks.at(a) - face.landmarks.at(b)).norm();
  };
  EXPECT_GT(between(second, "nasion", "pogonion"), between(first, "nasion", "pogonion") + 0.004);
  EXPECT_GT(between(second, "cheilion_L", "cheilion_R"),
            between(first, "cheilion_L", "cheilion_R") + 0.002);
  EXPECT_LT(between(second, "ibug68_62", "ibug68_66"), 0.0003) << "the lips nearly touch";
}

TEST(SecondFace, HasNoFolds) {
  const anatomy::EmbeddedFace first = anatomy::embedded_face(), second = second_face();
  for (Eigen::Index t = 0; t < second.mesh.triangles.rows(); ++t) {
    const Vec3 before = normal(first.mesh, t), after = normal(second.mesh, t);
    EXPECT_GT(before.dot(after), 0.3 * before.norm() * after.norm()) << "triangle " << t;
  }
}

TEST(SecondFace, ItsLandmarksLieOnItAndItsSidesDiffer) {
  const anatomy::EmbeddedFace face = second_face();
  const SurfaceTree surface(face.mesh);
  double asymmetry = 0;
  for (const auto& [name, at] : face.landmarks) {
    EXPECT_LT(std::sqrt(surface.query(at).squared_distance), 1e-5) << name;
    const Vec3 other = face.landmarks.at(face::mirrored_landmark(name));
    asymmetry = std::max(asymmetry, (at - other.cwiseProduct(Vec3(-1, 1, 1))).norm());
  }
  EXPECT_GT(asymmetry, 0.0008);
  EXPECT_LT(asymmetry, 0.006);
}

class Flawed : public testing::Test {
 protected:
  static const FlawedScan& scan() {
    static const FlawedScan made = flawed_scan(second_face());
    return made;
  }
  /// The scan in the face's frame.
  static TriMesh in_face() {
    TriMesh mesh = scan().mesh;
    const Eigen::Isometry3d face_from_scan = scan().scan_from_face.inverse();
    for (auto p : mesh.points.rowwise()) p = (face_from_scan * p.transpose().eval()).transpose();
    return mesh;
  }
};

TEST_F(Flawed, HasTheNoiseThatItStates) {
  const SurfaceTree truth(second_face().mesh);
  const TriMesh mesh = in_face();
  std::vector<double> off;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v)
    off.push_back(std::sqrt(truth.query(mesh.points.row(v).transpose()).squared_distance));
  std::sort(off.begin(), off.end());
  // The median of a normal variable's absolute value is 0.674 of its standard deviation.
  EXPECT_NEAR(quantile_of_sorted(off, 0.5) / 0.6745, ScanFlaws().noise_m,
              0.1 * ScanFlaws().noise_m);
  EXPECT_LT(off.back(), 0.004) << "the middle of the joined lips";
}

TEST_F(Flawed, HasHolesARaggedBorderAndJoinedLips) {
  const TriMesh mesh = in_face();
  const auto loops = boundary_loops(mesh.triangles);
  const auto landmarks = second_face().landmarks;
  const Vec3 stomion = landmarks.at("stomion");
  std::size_t outer = 0, holes = 0;
  for (const auto& loop : loops) {
    outer = std::max(outer, loop.size());
    Vec3 middle = Vec3::Zero();
    for (const int v : loop) middle += mesh.points.row(v).transpose() / double(loop.size());
    double radius = 0;
    for (const int v : loop)
      radius = std::max(radius, (mesh.points.row(v).transpose() - middle).norm());
    holes += std::abs(radius - ScanFlaws().hole_radius_m) < 0.0015;
    if (radius < 0.05) {
      EXPECT_GT((middle - stomion).norm(), 0.02) << "the mouth is closed";
    }
  }
  EXPECT_EQ(holes, 3U);
  EXPECT_EQ(loops.size(), 1U + 2U + 3U) << "the border, the eyes, the holes";
  EXPECT_GT(outer, 400U) << "ragged";
  const auto parts = triangle_components(mesh.triangles, mesh.points.rows());
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 0) << "one piece";
}

TEST_F(Flawed, TellsWhereItsLandmarksAre) {
  const SurfaceTree surface(scan().mesh);
  for (const char* name : {"pronasale", "cheilion_L", "exocanthion_R", "pogonion"})
    EXPECT_LT(std::sqrt(surface.query(scan().landmarks.at(name)).squared_distance), 0.002) << name;
}

}  // namespace
}  // namespace hyperex::sample
