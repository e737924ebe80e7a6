// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/corner_linings.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/anatomy/lips.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::tissue {
using namespace anatomy;
namespace {

/// The face with linings behind its lips: each lip continues backwards, out of sight.
TriMesh with_linings(const EmbeddedFace& face) {
  const std::vector<int> border = mouth_border(face.mesh, face.landmarks);
  const face::FaceFrame frame = face::face_frame(face.landmarks);
  const std::vector<double> margin = upper_lip_margin(face.mesh, face.landmarks);
  const auto count = Eigen::Index(border.size());
  TriMesh mesh = face.mesh;
  const Eigen::Index points = mesh.points.rows(), triangles = mesh.triangles.rows();
  mesh.points.conservativeResize(points + count, 3);
  mesh.triangles.conservativeResize(triangles + 2 * count, 3);
  for (Eigen::Index i = 0; i < count; ++i) {
    const int a = border[std::size_t(i)], b = border[std::size_t((i + 1) % count)];
    const int below_a = int(points + i), below_b = int(points + (i + 1) % count);
    const double away = margin[std::size_t(a)] > 0 ? 0.004 : -0.004;
    mesh.points.row(below_a) = mesh.points.row(a) + (away * frame.y - 0.005 * frame.z).transpose();
    mesh.triangles.row(triangles + 2 * i) << b, a, below_a;
    mesh.triangles.row(triangles + 2 * i + 1) << b, below_a, below_b;
  }
  return mesh;
}

TEST(CornerLinings, AFaceWithoutThemKeepsAll) {
  // With parted lips, as rims that lie on each other are such linings.
  EmbeddedFace face = embedded_face();
  const std::vector<double> margin = upper_lip_margin(face.mesh, face.landmarks);
  const double middle = face.landmarks.at("stomion").y();
  for (Eigen::Index v = 0; v < face.mesh.points.rows(); ++v)
    if (margin[std::size_t(v)] <= 0 && face.mesh.points(v, 1) < middle)
      face.mesh.points(v, 1) -= 0.004;
  TriMesh mesh = face.mesh;
  EXPECT_EQ(remove_corner_linings(mesh, face.landmarks), 0);
  EXPECT_EQ(mesh.points, face.mesh.points);
  EXPECT_EQ(mesh.triangles, face.mesh.triangles);
}

TEST(CornerLinings, AreGivenUpAtTheCornersAlone) {
  const EmbeddedFace face = embedded_face();
  TriMesh mesh = with_linings(face);
  const Points before = mesh.points;
  const Eigen::Index triangles = mesh.triangles.rows();
  const Eigen::Index ring = before.rows() - face.mesh.points.rows();
  const auto nearest_corner = [&](const Vec3& p) {
    return std::min((p - face.landmarks.at(face::ibug(60))).norm(),
                    (p - face.landmarks.at(face::ibug(64))).norm());
  };
  const int dropped = remove_corner_linings(mesh, face.landmarks);
  ASSERT_GT(dropped, 0);
  EXPECT_EQ(mesh.triangles.rows(), triangles - dropped);
  EXPECT_EQ(boundary_loops(mesh.triangles).size(), boundary_loops(face.mesh.triangles).size());
  int at_corners = 0, in_the_middle = 0;
  for (Eigen::Index i = before.rows() - ring; i < before.rows(); ++i) {
    const bool kept = (mesh.points.rowwise() - before.row(i)).rowwise().norm().minCoeff() < 1e-12;
    const double away = nearest_corner(before.row(i));
    at_corners += away < 0.009;
    if (away > 0.013) in_the_middle += !kept;
  }
  EXPECT_GT(dropped, at_corners / 2) << "of two triangles that hang on each";
  EXPECT_EQ(in_the_middle, 0) << "given up although far from the corners";
}

}  // namespace
}  // namespace hyperex::tissue
