// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <set>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {
namespace {

TEST(CanonicalFace, IsTheMeshOfThePackageInMetres) {
  const CanonicalFace& face = canonical_face();
  EXPECT_EQ(face.mesh.points.rows(), 468);
  EXPECT_EQ(face.mesh.triangles.rows(), 898);
  const Eigen::RowVector3d size =
      face.mesh.points.colwise().maxCoeff() - face.mesh.points.colwise().minCoeff();
  EXPECT_NEAR(size.x(), 0.155, 0.0005);
  EXPECT_NEAR(size.y(), 0.177, 0.0005);
  EXPECT_NEAR(size.z(), 0.100, 0.0005);
  EXPECT_EQ(boundary_loops(face.mesh.triangles).size(), 1u);
  EXPECT_GE(face.uv.minCoeff(), 0);
  EXPECT_LE(face.uv.maxCoeff(), 1);
  // Outside is where it should be: the face looks forward.
  EXPECT_GT(vertex_normals(face.mesh).row(4).z(), 0.5);
  EXPECT_EQ(&canonical_face(), &face);
}

TEST(CanonicalFace, EveryLandmarkIsThereAndOnItsSide) {
  const CanonicalFace& face = canonical_face();
  EXPECT_EQ(face.landmarks.size(), 68u + 24u);
  std::set<std::string> pairs, midline;
  for (const auto& [name, vertices] : face.landmarks) {
    const Vec3 p = face.landmark(name, face.mesh.points);
    const std::string other = mirrored_landmark(name);
    ASSERT_TRUE(face.landmarks.contains(other)) << name;
    EXPECT_EQ(mirrored_landmark(other), name);
    const Vec3 q = face.landmark(other, face.mesh.points);
    EXPECT_NEAR(p.x(), -q.x(), 0.0006) << name << " " << other;
    EXPECT_NEAR(p.y(), q.y(), 0.0006) << name << " " << other;
    EXPECT_NEAR(p.z(), q.z(), 0.0006) << name << " " << other;
    if (name.ends_with("_L")) {
      EXPECT_GT(p.x(), 0.004) << name;
    }
    if (name.ends_with("_R")) {
      EXPECT_LT(p.x(), -0.004) << name;
    }
    if (other == name) {
      EXPECT_NEAR(p.x(), 0, 1e-6) << name;
    }
  }
  const auto at = [&](const std::string& name) { return face.landmark(name, face.mesh.points); };
  // From top to bottom of the midline.
  const char* downwards[] = {"glabella",         "nasion",    "ibug68_28",        "ibug68_29",
                             "pronasale",        "subnasale", "labiale_superius", "stomion",
                             "labiale_inferius", "pogonion"};
  for (std::size_t i = 1; i < std::size(downwards); ++i)
    EXPECT_LT(at(downwards[i]).y(), at(downwards[i - 1]).y()) << downwards[i];
  EXPECT_EQ(at("ibug68_36"), at("exocanthion_R"));
  EXPECT_EQ(at("ibug68_54"), at("cheilion_L"));
  EXPECT_EQ(mirrored_landmark("nothing"), "nothing");
}

TEST(CanonicalFace, ContoursAreTheBordersOfTheOpenings) {
  const CanonicalFace& face = canonical_face();
  std::set<int> dropped(face.mouth.begin(), face.mouth.end());
  dropped.insert(face.left_eye.begin(), face.left_eye.end());
  dropped.insert(face.right_eye.begin(), face.right_eye.end());
  EXPECT_EQ(dropped.size(), 14u + 14u + 18u);
  Triangles kept(898 - 46, 3);
  for (int f = 0, row = 0; f < 898; ++f)
    if (!dropped.contains(f)) kept.row(row++) = face.mesh.triangles.row(f);
  std::set<std::set<int>> loops;
  for (const auto& loop : boundary_loops(kept)) loops.emplace(loop.begin(), loop.end());
  EXPECT_EQ(loops.size(), 4u);
  for (const auto* contour : {&lip_contour(), &left_eye_contour(), &right_eye_contour()})
    EXPECT_TRUE(loops.contains(std::set<int>(contour->begin(), contour->end())));
}

TEST(EmbeddedFace, IsFineOpenAndNearTheCanonicalFace) {
  const EmbeddedFace embedded = embedded_face();
  EXPECT_NEAR(double(embedded.mesh.points.rows()), 7000, 100);
  EXPECT_EQ(embedded.mesh.triangles.rows(), (898 - 46) * 16);
  EXPECT_EQ(boundary_loops(embedded.mesh.triangles).size(), 4u);  // outline, two eyes, mouth
  EXPECT_GT(triangle_areas(embedded.mesh).minCoeff(), 1e-9);
  const CanonicalFace& face = canonical_face();
  const SurfaceTree tree(embedded.mesh);
  double mean = 0, most = 0;
  for (Eigen::Index v = 0; v < 468; ++v) {
    const double distance = std::sqrt(tree.query(face.mesh.points.row(v)).squared_distance);
    mean += distance / 468;
    most = std::max(most, distance);
  }
  EXPECT_LT(mean, 0.0005);
  EXPECT_LT(most, 0.006);  // corners of eyes, mouth and outline are rounded
}

TEST(EmbeddedFace, LiesInThePictureWhereTheCanonicalFaceDoes) {
  const EmbeddedFace embedded = embedded_face();
  const CanonicalFace& face = canonical_face();
  ASSERT_EQ(embedded.uv.rows(), embedded.mesh.points.rows());
  // The canonical vertices are the first of the fine mesh; a unit is some 235 mm.
  const Eigen::VectorXf off = (embedded.uv.topRows(468) - face.uv).rowwise().norm();
  EXPECT_LT(off.mean(), 0.001);
  EXPECT_LT(off.maxCoeff(), 0.012) << "corners and outline are rounded";
  EXPECT_GT(embedded.uv.minCoeff(), 0);
  EXPECT_LT(embedded.uv.maxCoeff(), 1);
}

TEST(EmbeddedFace, LandmarksLieOnItsVerticesWhereTheCanonicalFaceHasThem) {
  const EmbeddedFace embedded = embedded_face();
  const CanonicalFace& face = canonical_face();
  EXPECT_EQ(embedded.landmarks.size(), face.landmarks.size());
  for (const auto& [name, p] : embedded.landmarks) {
    EXPECT_EQ((embedded.mesh.points.rowwise() - p.transpose()).rowwise().norm().minCoeff(), 0);
    EXPECT_LT((p - face.landmark(name, face.mesh.points)).norm(), 0.005) << name;
  }
}

}  // namespace
}  // namespace hyperex::anatomy
