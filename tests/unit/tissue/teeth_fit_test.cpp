// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/teeth/teeth_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {

bool in_tissue(const VolumeMesh& volume, const Vec3& p) {
  for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
    const Vec3 a = volume.nodes.row(volume.tets(t, 0));
    if ((p - a).squaredNorm() > 1e-3) continue;
    Eigen::Matrix3d edges;
    for (int k = 0; k < 3; ++k)
      edges.col(k) = volume.nodes.row(volume.tets(t, k + 1)).transpose() - a;
    const Vec3 share = edges.inverse() * (p - a);
    if (share.minCoeff() > 0 && share.sum() < 1) return true;
  }
  return false;
}

struct Fitted {
  io::Landmarks landmarks;
  TissueMesh mesh;
  TeethFit fit;

  Fitted() {
    const EmbeddedFace face = embedded_face();
    landmarks = face.landmarks;
    mesh = build_tissue_mesh(face.mesh, landmarks, {}, "embedded");
    fit = fit_teeth(mesh.volume.outer, boundary_of(mesh.volume), landmarks);
  }
  static const Fitted& get() {
    static const Fitted one;
    return one;
  }
};

TEST(FitTeeth, LiesBehindTheInnerSurface) {
  const auto& [landmarks, mesh, fit] = Fitted::get();
  ASSERT_EQ(fit.why_none, "");
  EXPECT_GE(fit.least_clearance_m, kTeethClearance_m);
  EXPECT_GT(fit.behind_lips_m, 0.002);
  EXPECT_LT(fit.behind_lips_m, 0.02);
  const VolumeMesh& volume = mesh.volume;
  const SurfaceTree skin(volume.outer);
  const SurfaceTree inner(
      {volume.nodes.bottomRows(volume.surface_nodes()), volume.outer.triangles});
  for (const JawTeeth* jaw : {&fit.teeth.upper, &fit.teeth.lower})
    for (const TriMesh* part : {&jaw->crowns, &jaw->gum})
      for (Eigen::Index v = 0; v < part->points.rows(); v += 3) {
        const Vec3 p = part->points.row(v);
        const double off_m = std::sqrt(inner.query(p).squared_distance);
        EXPECT_GT(off_m, 0.9 * kTeethClearance_m) << p.transpose();
        EXPECT_LT(off_m, 0.05);
        EXPECT_GT(std::sqrt(skin.query(p).squared_distance), 0.9 * kTeethClearance_m);
        EXPECT_FALSE(in_tissue(volume, p)) << p.transpose();
      }
}

TEST(FitTeeth, StandsUprightInTheMiddle) {
  const auto& [landmarks, mesh, fit] = Fitted::get();
  const face::FaceFrame frame = face::face_frame(landmarks);
  const Points upper = frame.local_points(fit.teeth.upper.crowns.points);
  const Points lower = frame.local_points(fit.teeth.lower.crowns.points);
  EXPECT_NEAR(upper.col(0).maxCoeff() + upper.col(0).minCoeff(), 0, 0.002);
  EXPECT_GT(upper.col(1).mean(), lower.col(1).mean() + 0.004);
  // The upper incisors' edges: 3 mm below the upper lip's; the lower ones' above the lower lip's.
  double edge = 1;
  for (Eigen::Index f = 0; f < fit.teeth.upper.crowns.triangles.rows(); ++f)
    if (fit.teeth.upper.tooth[std::size_t(f)] == 11)
      edge = std::min(edge, upper(fit.teeth.upper.crowns.triangles(f, 0), 1));
  EXPECT_NEAR(edge, frame.local(landmarks.at(face::ibug(62))).y() - 0.003, 6e-4);
  double lower_edge = -1;
  for (Eigen::Index f = 0; f < fit.teeth.lower.crowns.triangles.rows(); ++f)
    if (fit.teeth.lower.tooth[std::size_t(f)] == 31)
      lower_edge = std::max(lower_edge, lower(fit.teeth.lower.crowns.triangles(f, 0), 1));
  EXPECT_NEAR(lower_edge, frame.local(landmarks.at(face::ibug(66))).y() + 0.0005, 1e-3);
}

TEST(FitTeeth, SaysHowFarBehindTheLipsTheEdgesAre) {
  const auto& [landmarks, mesh, fit] = Fitted::get();
  const face::FaceFrame frame = face::face_frame(landmarks);
  const Points upper = frame.local_points(fit.teeth.upper.crowns.points);
  Vec3 edge(0, 1, 0);  // the lowest vertex of the right central incisor
  for (Eigen::Index f = 0; f < fit.teeth.upper.crowns.triangles.rows(); ++f)
    if (const Vec3 p = upper.row(fit.teeth.upper.crowns.triangles(f, 0));
        fit.teeth.upper.tooth[std::size_t(f)] == 11 && p.y() < edge.y())
      edge = p;
  const double meet = std::min(frame.local(landmarks.at(face::ibug(62))).z(),
                               frame.local(landmarks.at(face::ibug(66))).z());
  EXPECT_NEAR(meet - edge.z(), fit.behind_lips_m, 1.5e-3);
  // The edge of the upper lip's red is before that line: the whole lip lies between it and a tooth.
  EXPECT_GT(frame.local(landmarks.at(face::ibug(51))).z(), meet + 1e-3);
}

TEST(FitTeeth, FollowsTheFace) {
  const auto& [landmarks, mesh, fit] = Fitted::get();
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Vec3 shift(0.3, -0.2, 1);
  TissueMesh moved = mesh;
  io::Landmarks places;
  const auto move = [&](const Points& p) {
    return Points((p * turn.transpose()).rowwise() + shift.transpose());
  };
  moved.volume.nodes = move(mesh.volume.nodes);
  moved.volume.outer.points = move(mesh.volume.outer.points);
  for (const auto& [name, at] : landmarks) places[name] = turn * at + shift;
  const TeethFit other = fit_teeth(moved.volume.outer, boundary_of(moved.volume), places);
  ASSERT_EQ(other.why_none, "");
  EXPECT_LT((other.teeth.lower.crowns.points - move(fit.teeth.lower.crowns.points))
                .rowwise()
                .norm()
                .maxCoeff(),
            1e-6);
}

TEST(FitTeeth, SaysWhyThereAreNone) {
  const auto& [landmarks, mesh, fit] = Fitted::get();
  io::Landmarks few = landmarks;
  few.erase(face::ibug(62));
  EXPECT_NE(fit_teeth(mesh.volume.outer, boundary_of(mesh.volume), few).why_none.find("ibug68_62"),
            std::string::npos);
  TissueMesh joined = mesh;
  joined.volume.outer = canonical_face().mesh;
  const TeethFit none = fit_teeth(joined.volume.outer, boundary_of(joined.volume), landmarks);
  EXPECT_NE(none.why_none, "");
  EXPECT_TRUE(none.teeth.upper.empty());
  EXPECT_TRUE(none.teeth.lower.empty());
}

}  // namespace
}  // namespace hyperex::tissue
