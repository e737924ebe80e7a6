// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/landmarks.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/io/landmarks.hpp"
#include "hyperex/io/scan.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {

struct Face {
  TriMesh scan;
  io::Landmarks landmarks;
};

Face humface() {
  const std::filesystem::path folder = std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real";
  Face face;
  face.scan = io::read_scan(folder / "humface.ply").mesh;
  face.landmarks = complete_landmarks(io::read_landmarks(folder / "humface_landmarks.json"),
                                      face::all_ibug(), face.scan)
                       .landmarks;
  return face;
}

bool have_humface() {
  return std::filesystem::exists(std::filesystem::path(HYPEREX_SHARED_DIR) /
                                 "data/real/humface.ply");
}

/// The canonical face, whose mouth is closed by triangles.
Face closed_face() {
  Face face{canonical_face().mesh, {}};
  for (const auto& name : face::all_ibug())
    face.landmarks[name] = canonical_face().landmark(name, face.scan.points);
  return face;
}

TissueMesh cut_mesh(const Face& face) {
  TissueMeshOptions options;
  options.trim_border_m = 0.004;
  return build_tissue_mesh(face.scan, face.landmarks, options, "scan");
}

/// Conditions for the skin of every scan with joined lips.
void expect_cut(const Face& face, const TissueMesh& mesh) {
  ASSERT_GT(mesh.lip_cut.rows(), 5);
  EXPECT_EQ(mesh.scan_vertices, face.scan.points.rows());
  EXPECT_TRUE(mesh.skin.points.topRows(mesh.scan_vertices) == face.scan.points);
  EXPECT_EQ(mesh.skin.points.rows(),
            mesh.scan_vertices + static_cast<Eigen::Index>(mesh.appended.size()));
  EXPECT_TRUE(mouth_is_open(mesh.skin, face.landmarks));
  EXPECT_TRUE(mouth_is_open(mesh.volume.outer, face.landmarks)) << "the working copy is cut too";
  for (std::size_t i = 0; i < mesh.appended.size(); ++i) {
    const EdgePoint& e = mesh.appended[i];
    const Vec3 p = mesh.skin.points.row(mesh.scan_vertices + static_cast<Eigen::Index>(i));
    EXPECT_LT((e.on(face.scan.points) - p).norm(), 1e-12);
  }
  Eigen::VectorXd pieces = Eigen::VectorXd::Zero(face.scan.triangles.rows());
  const Eigen::VectorXd areas = triangle_areas(mesh.skin);
  for (Eigen::Index f = 0; f < areas.size(); ++f) pieces[mesh.source_triangle[f]] += areas[f];
  EXPECT_LT((pieces - triangle_areas(face.scan)).cwiseAbs().maxCoeff(), 1e-12);
}

/// The skin vertices of each rim are carried by elements of their own lip. The points on edges, of
/// the upper rim, are appended first, then the copies for the lower rim.
void expect_rims_on_their_own_lips(const TissueMesh& mesh) {
  std::set<int> upper_rim, lower_rim;
  for (const auto& loop : boundary_loops(mesh.skin.triangles)) {
    int copies = 0;
    for (int v : loop) copies += v >= mesh.scan_vertices;
    if (copies == 0) continue;
    for (int v : loop) (mesh.skin_upper_margin[v] > 0 ? upper_rim : lower_rim).insert(v);
  }
  EXPECT_GT(upper_rim.size(), 5u);
  EXPECT_NEAR(double(upper_rim.size()), double(lower_rim.size()), 2) << "the corners are shared";
  for (const auto* rim : {&upper_rim, &lower_rim})
    for (int v : *rim) {
      if (std::abs(mesh.skin_upper_margin[v]) < 1e-9) continue;  // a corner
      double margin = 0;
      for (int k = 0; k < 3; ++k)
        margin += mesh.anchors[v].weight[k] * mesh.upper_margin[mesh.anchors[v].node[k]];
      EXPECT_GT(margin * mesh.skin_upper_margin[v], 0) << v;
    }
}

TEST(LipCut, ClosedCanonicalFaceIsCutByItsLandmarksOrCrease) {
  const Face face = closed_face();
  const TissueMesh mesh = cut_mesh(face);
  expect_cut(face, mesh);
  expect_rims_on_their_own_lips(mesh);
}

/// Files with several normals at a vertex repeat it, at worst once per triangle.
TEST(LipCut, OfAScanWhoseTrianglesShareNoVerticesLeavesOneSkin) {
  const Face whole = closed_face();
  Face parted = whole;
  const Triangles& triangles = whole.scan.triangles;
  parted.scan.points.resize(triangles.size(), 3);
  for (Eigen::Index i = 0; i < triangles.size(); ++i) {
    parted.scan.points.row(i) = whole.scan.points.row(triangles.data()[i]);
    parted.scan.triangles.data()[i] = int(i);
  }
  const TissueMesh mesh = cut_mesh(parted), expected = cut_mesh(whole);
  EXPECT_EQ(boundary_loops(mesh.skin.triangles).size(),
            boundary_loops(expected.skin.triangles).size());
  EXPECT_TRUE(mouth_is_open(mesh.skin, parted.landmarks));
  EXPECT_TRUE(mesh.skin.points.topRows(mesh.scan_vertices) == parted.scan.points)
      << "files refer to them by number";
  expect_rims_on_their_own_lips(mesh);
  const std::vector<int> first = first_at_same_place(parted.scan.points);
  std::map<int, const RimVertex*> rim;
  for (const RimVertex& vertex : mesh.rim) rim[vertex.vertex] = &vertex;
  EXPECT_EQ(rim.size(), mesh.rim.size());
  for (std::size_t v = 0; v < first.size(); ++v) {
    const auto one = std::size_t(first[v]);
    EXPECT_EQ(mesh.anchors[v].node, mesh.anchors[one].node) << v;
    ASSERT_EQ(rim.contains(int(v)), rim.contains(int(one))) << v;
    if (!rim.contains(int(v))) continue;
    EXPECT_EQ(rim[int(v)]->node, rim[int(one)]->node) << v;
  }
}

TEST(LipCut, CanBeForbidden) {
  const Face face = closed_face();
  TissueMeshOptions options;
  options.cut_lips = LipCut::never;
  const TissueMesh mesh = build_tissue_mesh(face.scan, face.landmarks, options, "scan");
  EXPECT_TRUE(mesh.skin.triangles == face.scan.triangles);
  EXPECT_EQ(mesh.lip_cut.rows(), 0);
  EXPECT_FALSE(mouth_is_open(mesh.volume.outer, face.landmarks));
}

TEST(LipCut, OnARealScanIsSmoothFromCornerToCorner) {
  if (!have_humface()) GTEST_SKIP() << "needs the shared scan humface.ply";
  const Face face = humface();
  const TissueMesh mesh = cut_mesh(face);
  expect_cut(face, mesh);
  expect_rims_on_their_own_lips(mesh);
  // Within a millimetre of the landmarks at its ends, and without teeth: seen from in front, no
  // vertex stands off the chord of the vertices 3 mm beside it by over half a millimetre.
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  std::vector<Vec3> line;
  for (Eigen::Index i = 0; i < mesh.lip_cut.rows(); ++i)
    line.push_back(frame.local(mesh.lip_cut.row(i)));
  EXPECT_LT((mesh.lip_cut.row(0).transpose() - face.landmarks.at(face::ibug(48))).norm(), 0.001);
  EXPECT_LT((mesh.lip_cut.bottomRows(1).transpose() - face.landmarks.at(face::ibug(54))).norm(),
            0.001);
  const auto height = [&](double x) {
    for (std::size_t i = 0; i + 1 < line.size(); ++i)
      if (line[i].x() <= x && x <= line[i + 1].x())
        return line[i].y() + (x - line[i].x()) / (line[i + 1].x() - line[i].x()) *
                                 (line[i + 1].y() - line[i].y());
    return std::nan("");
  };
  int judged = 0;
  for (const Vec3& p : line) {
    const double chord = 0.5 * (height(p.x() - 0.003) + height(p.x() + 0.003));
    if (std::isnan(chord)) continue;
    ++judged;
    EXPECT_LT(std::abs(p.y() - chord), 0.0005) << 1e3 * p.x();
  }
  EXPECT_GT(judged, 20);
}

TEST(LipCut, RimOfTheSimulatedSkinLiesOnTheCut) {
  if (!have_humface()) GTEST_SKIP() << "needs the shared scan humface.ply";
  const Face face = humface();
  const TissueMesh mesh = cut_mesh(face);
  const Points& outer = mesh.volume.outer.points;
  int near_ends = 0;
  for (const auto& loop : boundary_loops(mesh.volume.outer.triangles)) {
    const Vec3 first = outer.row(loop.front());
    if ((first - face.landmarks.at(face::ibug(62))).norm() > 0.03 || loop.size() < 10) continue;
    for (int v : loop) {
      EXPECT_LT((mesh.lip_cut.rowwise() - outer.row(v)).rowwise().norm().minCoeff(), 0.0012);
      for (const Eigen::Index end : {Eigen::Index(0), mesh.lip_cut.rows() - 1})
        near_ends += (mesh.lip_cut.row(end) - outer.row(v)).norm() < 0.0005;
    }
  }
  EXPECT_EQ(near_ends, 2) << "the corners of the mouth stay where they are";
}

}  // namespace
}  // namespace hyperex::tissue
