// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/scan/lid_edges.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace hyperex::tracking {
namespace {

/// Adds a strip 40 mm wide along a profile of (up, front), mm, from its upper end to its lower.
void add_strip(TriMesh& mesh, const std::vector<std::pair<double, double>>& profile_mm) {
  const Eigen::Index points = mesh.points.rows(), triangles = mesh.triangles.rows();
  const auto count = Eigen::Index(profile_mm.size());
  mesh.points.conservativeResize(points + 2 * count, 3);
  mesh.triangles.conservativeResize(triangles + 2 * (count - 1), 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const auto& [up, front] = profile_mm[std::size_t(i)];
    mesh.points.row(points + 2 * i) << -0.02, 1e-3 * up, 1e-3 * front;
    mesh.points.row(points + 2 * i + 1) << 0.02, 1e-3 * up, 1e-3 * front;
    if (i + 1 == count) break;
    const int a = int(points + 2 * i);
    mesh.triangles.row(triangles + 2 * i) << a, a + 2, a + 3;
    mesh.triangles.row(triangles + 2 * i + 1) << a, a + 3, a + 1;
  }
}

/// Two lids 8 mm apart; the inner side of each leads back by 3 mm.
TriMesh lids() {
  TriMesh mesh;
  add_strip(mesh, {{20, 0}, {0, 0}, {2, -3}});
  add_strip(mesh, {{-10, -3}, {-8, 0}, {-28, 0}});
  return mesh;
}

TEST(LidEdges, AreWhereLandmarksOfTheInnerSidesGo) {
  io::Landmarks landmarks = {{"ibug68_43", {0.002, 0.0018, -0.0027}},
                             {"ibug68_47", {0.002, -0.0098, -0.0027}}};
  lids_to_edges(landmarks, lids(), Eigen::Matrix3d::Identity());
  EXPECT_LT((landmarks.at("ibug68_43") - Vec3(0.002, 0, 0)).norm(), 2e-4);
  EXPECT_LT((landmarks.at("ibug68_47") - Vec3(0.002, -0.008, 0)).norm(), 2e-4);
}

TEST(LidEdges, LandmarksThatAreSeenStay) {
  const io::Landmarks seen = {{"ibug68_43", {0, 0.001, 0}}, {"ibug68_47", {0, -0.009, 0}}};
  io::Landmarks landmarks = seen;
  lids_to_edges(landmarks, lids(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(landmarks, seen);
}

TEST(LidEdges, LandmarksFarFromAnEdgeStay) {
  const io::Landmarks far = {{"ibug68_43", {0, 0.006, -0.0027}}, {"ibug68_47", {0, -0.009, 0}}};
  io::Landmarks landmarks = far;
  lids_to_edges(landmarks, lids(), Eigen::Matrix3d::Identity());
  EXPECT_EQ(landmarks, far) << "more than 4 mm";
}

}  // namespace
}  // namespace hyperex::tracking
