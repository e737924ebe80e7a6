// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/face_backing.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "unit/report/made_up_face.hpp"

namespace hyperex::report {
namespace {

const anatomy::EmbeddedFace& embedded() {
  static const anatomy::EmbeddedFace face = anatomy::embedded_face();
  return face;
}

TEST(FaceBacking, FindsEyesAndMouthOfTheEmbeddedFaceAndNotItsBorder) {
  const auto& face = embedded();
  const FaceBacking backing = face_backing(face.mesh, face.landmarks);
  ASSERT_EQ(backing.openings.size(), 3u);
  for (const char* inside : {"ibug68_37", "ibug68_44", "ibug68_62"}) {
    double nearest_m = INFINITY;
    for (const Opening& opening : backing.openings)
      for (const int v : opening.loop)
        nearest_m = std::min(
            nearest_m, (face.mesh.points.row(v).transpose() - face.landmarks.at(inside)).norm());
    EXPECT_LT(nearest_m, 3e-3) << inside;
  }
  for (const Opening& opening : backing.openings) {
    EXPECT_NEAR(opening.inward.norm(), 1, 1e-12);
    EXPECT_LT(opening.inward.z(), -0.8) << "+z looks forward";
    Vec3 centre = Vec3::Zero();
    for (const int v : opening.loop)
      centre += face.mesh.points.row(v).transpose() / double(opening.loop.size());
    EXPECT_EQ(opening.mouth, centre.y() < face.landmarks.at("ibug68_33").y());
    EXPECT_EQ(opening.depth_m > 0.035, centre.y() < face.landmarks.at("ibug68_33").y());
  }
}

/// The embedded face with a hole of 8 mm about the vertex that is seen nearest to a place.
TriMesh with_a_hole(const Vec3& place) {
  TriMesh mesh = embedded().mesh;
  Eigen::Index nearest = 0;
  (mesh.points.leftCols<2>().rowwise() - place.head<2>().transpose())
      .rowwise()
      .squaredNorm()
      .minCoeff(&nearest);
  const Points all = mesh.points;
  Eigen::Index count = 0;
  for (Eigen::Index t = 0; t < mesh.triangles.rows(); ++t) {
    bool inside = true;
    for (int k = 0; k < 3; ++k)
      inside = inside && (all.row(mesh.triangles(t, k)) - all.row(nearest)).norm() < 0.008;
    if (!inside) mesh.triangles.row(count++) = embedded().mesh.triangles.row(t);
  }
  mesh.triangles.conservativeResize(count, 3);
  return mesh;
}

TEST(FaceBacking, BacksAHoleOfTheCheekBesideTheEyes) {
  const auto& landmarks = embedded().landmarks;
  const Vec3 beside = landmarks.at("cheek_R") + Vec3(-0.018, -0.002, 0);
  ASSERT_LT(beside.x(), landmarks.at("ibug68_36").x()) << "not between the outer corners";
  const TriMesh skin = with_a_hole(beside);
  const FaceBacking backing = face_backing(skin, landmarks);
  ASSERT_EQ(backing.openings.size(), 4u);
  const Points normals = vertex_normals(skin);
  for (const Opening& hole : backing.openings) {
    if (skin.points(hole.loop.front(), 0) > landmarks.at("ibug68_36").x()) continue;
    Vec3 outward = Vec3::Zero();
    for (const int v : hole.loop) outward += normals.row(v).transpose().normalized();
    const auto n = Eigen::Index(hole.loop.size());
    for (Eigen::Index i = n; i < hole.rest.rows(); ++i)
      EXPECT_LT((hole.rest.row(i) - hole.rest.row(i % n)).dot(outward.transpose()), 0)
          << "behind the skin";
  }
  // At the temple, 8 mm from the border, a scan may be torn.
  const Vec3 at_border = landmarks.at("ibug68_36") + Vec3(-0.0225, 0.020, 0);
  EXPECT_EQ(face_backing(with_a_hole(at_border), landmarks).openings.size(), 3u);
}

TEST(FaceBacking, KnowsWhichEyesAreOpen) {
  const auto& face = embedded();
  FaceBacking backing = face_backing(face.mesh, face.landmarks);
  using Both = std::array<bool, 2>;
  EXPECT_EQ(open_eyes(backing, face.mesh.points, face.landmarks), (Both{true, true}));
  // The left eye is closed: it has no opening.
  std::erase_if(backing.openings, [&](const Opening& opening) {
    return !opening.mouth && face.mesh.points(opening.loop.front(), 0) > 0;
  });
  EXPECT_EQ(open_eyes(backing, face.mesh.points, face.landmarks), (Both{true, false}));
  EXPECT_EQ(open_eyes(backing, face.mesh.points, {}), Both{});
}

// A scan that ends on the cheeks: seen in profile, no pocket stands out behind its border.
TEST(FaceBacking, APocketIsNoDeeperThanTheScan) {
  const auto& face = embedded();
  const Vec3 corner = (face.landmarks.at("cheilion_L") + face.landmarks.at("cheilion_R")) / 2;
  constexpr double kept_m = 0.03;  // behind the corners of the mouth
  TriMesh mask = face.mesh;
  Eigen::Index count = 0;
  for (const auto& t : face.mesh.triangles.rowwise())
    if (face.mesh.points(t[0], 2) > corner.z() - kept_m &&
        face.mesh.points(t[1], 2) > corner.z() - kept_m &&
        face.mesh.points(t[2], 2) > corner.z() - kept_m)
      mask.triangles.row(count++) = t;
  mask.triangles.conservativeResize(count, 3);
  const FaceBacking backing = face_backing(mask, face.landmarks);
  ASSERT_GE(backing.openings.size(), 1u);
  for (const Opening& opening : backing.openings)
    for (const double back_m : {0.0, 0.008}) {
      // A smile moves the lips back; other openings stay.
      if (back_m > 0 && !opening.mouth) continue;
      Points points = mask.points;
      for (const int v : opening.loop) points(v, 2) -= back_m;
      EXPECT_GT(pocket(opening, points).points.col(2).minCoeff(), corner.z() - kept_m) << back_m;
    }
}

TEST(FaceBacking, EyeballsLieBehindTheLidsAndAreSeenBetweenThem) {
  const auto& face = embedded();
  const FaceBacking backing = face_backing(face.mesh, face.landmarks);
  ASSERT_EQ(backing.eyeballs.size(), 2u);
  EXPECT_LT(backing.eyeballs[0].centre.x(), 0) << "the subject's right first";
  for (std::size_t side = 0; side < 2; ++side) {
    const Eyeball& eye = backing.eyeballs[side];
    EXPECT_GT(eye.radius_m, 0.008);
    EXPECT_LT(eye.radius_m, 0.015);
    for (Eigen::Index v = 0; v < face.mesh.points.rows(); ++v) {
      const Vec3 off = face.mesh.points.row(v).transpose() - eye.centre;
      if (off.dot(eye.gaze) > 0.35 * eye.radius_m) {
        EXPECT_GT(off.norm(), eye.radius_m) << v;
      }
    }
    // Not sunk: its front is within 4 mm of the plane of the lids' edges.
    const Vec3 lid = (face.landmarks.at(side ? "ibug68_43" : "ibug68_38") +
                      face.landmarks.at(side ? "ibug68_47" : "ibug68_40")) /
                     2;
    const double depth_m = (lid - eye.centre).dot(eye.gaze) - eye.radius_m;
    EXPECT_LT(std::abs(depth_m), 4e-3) << depth_m;
  }
}

TEST(FaceBacking, APocketIsClosedButForItsEdgeAndLiesBehindIt) {
  const auto face = testing::made_up_face(testing::Surface::plain);
  const TriMesh& skin = face.performance.skin_rest;
  std::map<std::string, Vec3> landmarks;
  const auto& tracks = face.performance.landmarks;
  for (std::size_t i = 0; i < tracks.names.size(); ++i)
    landmarks[tracks.names[i]] = tracks.positions[0].row(Eigen::Index(i)).transpose();
  const FaceBacking backing = face_backing(skin, landmarks);
  ASSERT_EQ(backing.openings.size(), 1u) << "the cut, not the border";
  EXPECT_TRUE(backing.eyeballs.empty()) << "without the inner corners of the eyes";
  const Opening& opening = backing.openings[0];
  const Points moved = skin.points + face.performance.skin_displacement_m[15].cast<double>();
  const TriMesh mesh = pocket(opening, moved);
  ASSERT_EQ(boundary_loops(mesh.triangles).size(), 1u);
  const auto n = Eigen::Index(opening.loop.size());
  EXPECT_EQ(boundary_loops(mesh.triangles)[0].size(), opening.loop.size());
  for (Eigen::Index i = 0; i < n; ++i) {
    EXPECT_EQ(mesh.points.row(i), moved.row(opening.loop[std::size_t(i)])) << "hangs on the edge";
    EXPECT_LT(opening.rest(n + i, 2), opening.rest(i, 2)) << "behind it at rest: +z looks forward";
  }
  landmarks.erase("cheilion_L");
  EXPECT_TRUE(face_backing(skin, landmarks).openings.empty());
}

TEST(FaceBacking, LightFallsOffBehindTheLips) {
  TriMesh row;
  row.points.resize(3, 3);
  row.points << 0, 0, 0.05, 0.01, 0, 0.0325, 0.02, 0, -0.1;
  const Eigen::VectorXd light = light_in_mouth(row, row, Vec3::UnitZ());
  EXPECT_DOUBLE_EQ(light[0], 1);
  EXPECT_NEAR(light[1], 0.675, 1e-12);
  EXPECT_DOUBLE_EQ(light[2], 0.35);
  EXPECT_EQ(light_in_mouth(TriMesh{}, row, Vec3::UnitZ()).size(), 0);
  EXPECT_EQ(light_in_mouth(row, TriMesh{}, Vec3::UnitZ()).minCoeff(), 1);
}

TEST(FaceBacking, LessLightPassesBetweenClosedLips) {
  // A slit of 50 mm, one vertex beside the others at each corner.
  const std::vector<int> loop = {0, 1, 2, 3};
  const auto light = [&](double opening_m) {
    Points slit(4, 3);
    slit << 0, 0, 0, 0.05, 0, 0, 0.05, opening_m, 0, 0, opening_m, 0;
    return light_between_lips(loop, slit);
  };
  EXPECT_DOUBLE_EQ(light(0), 0.15);
  const double mean_m = 2 * 0.05 * 0.003 / (2 * (0.05 + 0.003));
  EXPECT_NEAR(light(0.003), 0.15 + 0.85 * (1 - std::exp(-mean_m / 1.5e-3)), 1e-12);
  EXPECT_GT(light(0.015), 0.99);
}

}  // namespace
}  // namespace hyperex::report
