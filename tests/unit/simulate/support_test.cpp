// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/support.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "simulate/small_face.hpp"
#include "support/sheet_mesh.hpp"

namespace hyperex::simulate {
namespace {

using face::ibug;

TEST(BonesUnder, FollowTheAnatomy) {
  const test::SmallFace face = test::small_face();
  const auto bones = bones_under(face.mesh, face.landmarks);
  ASSERT_EQ(static_cast<Eigen::Index>(bones.size()), face.mesh.volume.surface_nodes());
  const Points& skin = face.mesh.skin.points;
  const auto at = [&](const Vec3& p) { return bones[nearest_vertex(skin, p)]; };
  const auto landmark = [&](int k) { return face.landmarks.at(ibug(k)); };
  for (int k : {19, 24, 27, 36, 45}) EXPECT_EQ(at(landmark(k)), Bone::skull) << k;
  EXPECT_EQ(at(landmark(8)), Bone::mandible);
  for (int k : {51, 57}) EXPECT_EQ(at(landmark(k)), Bone::none) << k;  // lips
  for (const Bone bone : {Bone::none, Bone::skull, Bone::mandible})
    EXPECT_GT(std::count(bones.begin(), bones.end(), bone), 5) << int(bone);
}

TEST(BonesUnder, AreAlikeOnBothSides) {
  const test::SmallFace face = test::small_face();
  const auto bones = bones_under(face.mesh, face.landmarks);
  const Points& skin = face.mesh.skin.points;
  int alike = 0, pairs = 0;
  for (int v = 0; v < skin.rows(); ++v) {
    const Vec3 mirrored(-skin(v, 0), skin(v, 1), skin(v, 2));
    const int w = nearest_vertex(skin, mirrored);
    if ((skin.row(w).transpose() - mirrored).norm() > 1e-4) continue;
    ++pairs;
    alike += bones[v] == bones[w];
  }
  EXPECT_GT(pairs, 200);
  EXPECT_GT(alike, 0.97 * pairs);
}

TEST(NearJaw, IsTheLowerFaceOnly) {
  const test::SmallFace face = test::small_face();
  const auto near = near_jaw(face.mesh, face.landmarks);
  const auto at = [&](int k) {
    return near[nearest_vertex(face.mesh.skin.points, face.landmarks.at(ibug(k)))];
  };
  for (int k : {5, 8, 11}) EXPECT_TRUE(at(k)) << k;
  for (int k : {0, 16, 19, 24, 27, 30, 36, 45}) EXPECT_FALSE(at(k)) << k;
}

TEST(OverFrontalis, IsTheForeheadAboveTheBrows) {
  const test::SmallFace face = test::small_face();
  const std::vector<char> over = over_frontalis(face.mesh, face.landmarks);
  const Points& skin = face.mesh.skin.points;
  const auto above = [&](int k, double height_m) {
    const Vec3 up(0, height_m, 0);
    return over[std::size_t(nearest_vertex(skin, face.landmarks.at(ibug(k)) + up))];
  };
  for (const int k : {18, 21, 22, 25}) EXPECT_TRUE(above(k, 0.015)) << k;
  for (const int k : {0, 8, 16, 30, 36, 45, 51}) EXPECT_FALSE(above(k, 0)) << k;
  for (Eigen::Index v = 0; v < skin.rows(); ++v) {
    double nearest = 1, height = 0;
    for (int k = 17; k <= 26; ++k)
      if (const Vec3 from = skin.row(v).transpose() - face.landmarks.at(ibug(k));
          from.norm() < nearest) {
        nearest = from.norm();
        height = from.y();
      }
    if (nearest > 0.036 || height < -0.002) {
      EXPECT_FALSE(over[std::size_t(v)]) << v;
    }
    if (nearest < 0.034 && height > 0.002) {
      EXPECT_TRUE(over[std::size_t(v)]) << v;
    }
  }
}

TEST(EdgeOfJaw, IsTheLineOfTheChin) {
  const test::SmallFace face = test::small_face();
  const std::vector<EdgeOfJaw> edge = edge_of_jaw(face.mesh, face.landmarks);
  const Points& skin = face.mesh.volume.outer.points;
  std::vector<Vec3> line;  // in steps of less than 0.1 mm
  for (int k = 5; k < 11; ++k)
    for (int step = 0; step < 1000; ++step)
      line.push_back((1 - step / 1e3) * face.landmarks.at(ibug(k)) +
                     step / 1e3 * face.landmarks.at(ibug(k + 1)));
  line.push_back(face.landmarks.at(ibug(11)));
  for (Eigen::Index v = 0; v < skin.rows(); v += 7) {
    double least = 1;
    for (const Vec3& p : line) least = std::min(least, (p - skin.row(v).transpose()).norm());
    const EdgeOfJaw& e = edge[std::size_t(v)];
    EXPECT_NEAR(e.distance_m, least, 1e-4) << v;
    EXPECT_NEAR((e.nearest - skin.row(v).transpose()).norm(), e.distance_m, 1e-12) << v;
  }
  const auto at = [&](const Vec3& p) { return edge[std::size_t(nearest_vertex(skin, p))]; };
  EXPECT_FALSE(at(face.landmarks.at(ibug(57))).below) << "the lower lip";
  EXPECT_FALSE(at(face.landmarks.at(ibug(30))).below) << "the nose";
}

TEST(NodeAreas, ShareOutTheSurface) {
  const auto sheet = hyperex::test::sheet_mesh({6, 5}, {0.06, 0.05});
  const Eigen::VectorXd areas = node_areas(sheet.mesh);
  EXPECT_NEAR(areas.sum(), 0.003, 1e-15);
  EXPECT_NEAR(areas[sheet.vertex(3, 2)], 1e-4, 1e-15) << "a cell's worth inside";
  EXPECT_NEAR(areas[sheet.vertex(3, 0)], 0.5e-4, 1e-15) << "half on the border";
  const test::SmallFace face = test::small_face();
  EXPECT_NEAR(node_areas(face.mesh.skin).sum(), triangle_areas(face.mesh.skin).sum(), 1e-12);
}

/// The inner surface over one bone.
TriMesh inner_over(const tissue::TissueMesh& mesh, const std::vector<Bone>& under, Bone bone) {
  const Triangles& all = mesh.volume.outer.triangles;
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < all.rows(); ++f) {
    bool over = true;
    for (int k = 0; k < 3; ++k) over = over && under[std::size_t(all(f, k))] == bone;
    if (over) kept.push_back(f);
  }
  return {mesh.volume.nodes.bottomRows(mesh.volume.surface_nodes()), all(kept, Eigen::all)};
}

TEST(BonesUnder, HoldTheCartilageOfTheNoseThatNoCtShows) {
  test::SmallFace face = test::small_face();
  const auto estimated = bones_under(face.mesh, face.landmarks);
  // A skull without a nose: only what lies above the eyes' line, far from it.
  TriMesh skull = inner_over(face.mesh, estimated, Bone::skull);
  const double nasion = face.landmarks.at(ibug(27)).y();
  std::vector<int> kept;
  for (Eigen::Index t = 0; t < skull.triangles.rows(); ++t)
    if (skull.points(skull.triangles(t, 0), 1) > nasion) kept.push_back(int(t));
  skull.triangles = skull.triangles(kept, Eigen::all).eval();
  face.mesh.bones = std::make_shared<const anatomy::Bones>(skull, TriMesh{});
  const auto given = bones_under(face.mesh, face.landmarks);
  const auto at = [&](const Vec3& p) { return given[nearest_vertex(face.mesh.skin.points, p)]; };
  EXPECT_EQ(at(face.landmarks.at(ibug(30))), Bone::skull) << "the tip";
  EXPECT_EQ(at(face.landmarks.at(ibug(29))), Bone::skull);
  EXPECT_EQ(at(face.landmarks.at(ibug(28))), Bone::none) << "bone, which is missing here";
  EXPECT_EQ(at(face.landmarks.at(ibug(51))), Bone::none) << "the lip";
  EXPECT_EQ(at(face.landmarks.at(ibug(2))), Bone::none) << "the cheek";
}

TEST(BonesUnder, AreThoseThatAreGivenWhereTissueIsAttached) {
  test::SmallFace face = test::small_face();
  const auto estimated = bones_under(face.mesh, face.landmarks);
  EXPECT_EQ(std::ranges::count(backed_by_bone(face.mesh, face.landmarks), 0), 0)
      << "no bones are known";
  TriMesh skull = inner_over(face.mesh, estimated, Bone::skull);
  TriMesh jaw = inner_over(face.mesh, estimated, Bone::mandible);
  face.mesh.bones = std::make_shared<const anatomy::Bones>(skull, jaw);
  const auto given = bones_under(face.mesh, face.landmarks);
  const auto backed = backed_by_bone(face.mesh, face.landmarks);
  int same = 0;
  for (std::size_t v = 0; v < given.size(); ++v) {
    same += given[v] == estimated[v];
    if (given[v] != Bone::none) {
      EXPECT_EQ(given[v], estimated[v]) << v;
      EXPECT_TRUE(backed[v]) << v;
    }
  }
  EXPECT_GT(same, 0.93 * double(given.size()));
  EXPECT_GT(std::ranges::count(backed, 0), 20) << "over the cavities";
  // Bone under the lips: the tissue is not attached there, and it is backed.
  TriMesh all = skull;
  all.triangles = face.mesh.volume.outer.triangles;
  face.mesh.bones = std::make_shared<const anatomy::Bones>(all, TriMesh());
  EXPECT_EQ(std::ranges::count(backed_by_bone(face.mesh, face.landmarks), 0), 0);
  const auto everywhere = bones_under(face.mesh, face.landmarks);
  const auto at = [&](int k) {
    return everywhere[std::size_t(
        nearest_vertex(face.mesh.skin.points, face.landmarks.at(ibug(k))))];
  };
  for (const int k : {51, 57, 48, 54}) EXPECT_EQ(at(k), Bone::none) << k;
  for (const int k : {27, 19, 24}) EXPECT_EQ(at(k), Bone::skull) << k;
}

}  // namespace
}  // namespace hyperex::simulate
