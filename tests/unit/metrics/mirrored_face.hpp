// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The canonical face, which is symmetric about x = 0, and functions to rotate and roughen it.
#include <Eigen/Geometry>
#include <random>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::metrics::testing {

struct Face {
  TriMesh mesh;
  io::Landmarks landmarks;
};

/// The mesh with each triangle cut into four, `times` times, to have enough vertices.
inline TriMesh finer(TriMesh mesh, int times) {
  for (; times > 0; --times) {
    std::map<std::pair<int, int>, int> middle;
    std::vector<Vec3> points;
    for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) points.push_back(mesh.points.row(v));
    const auto between = [&](int a, int b) {
      const auto key = std::minmax(a, b);
      const auto [at, fresh] = middle.try_emplace(key, static_cast<int>(points.size()));
      if (fresh) points.push_back(0.5 * (points[size_t(a)] + points[size_t(b)]));
      return at->second;
    };
    Triangles triangles(4 * mesh.triangles.rows(), 3);
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
      const int a = mesh.triangles(f, 0), b = mesh.triangles(f, 1), c = mesh.triangles(f, 2);
      const int ab = between(a, b), bc = between(b, c), ca = between(c, a);
      triangles.row(4 * f) << a, ab, ca;
      triangles.row(4 * f + 1) << b, bc, ab;
      triangles.row(4 * f + 2) << c, ca, bc;
      triangles.row(4 * f + 3) << ab, bc, ca;
    }
    mesh.triangles = triangles;
    mesh.points.resize(static_cast<Eigen::Index>(points.size()), 3);
    for (size_t v = 0; v < points.size(); ++v)
      mesh.points.row(static_cast<Eigen::Index>(v)) = points[v].transpose();
  }
  return mesh;
}

inline Face mirrored_face(int times_finer = 1) {
  const auto& canonical = face::canonical_face();
  Face face{finer({canonical.mesh.points, face::opened_triangles(canonical)}, times_finer), {}};
  for (const auto& entry : canonical.landmarks)
    face.landmarks[entry.first] = canonical.landmark(entry.first, canonical.mesh.points);
  return face;
}

inline void move(Face& face, const Eigen::Isometry3d& moved) {
  face.mesh.points =
      ((face.mesh.points * moved.linear().transpose()).rowwise() + moved.translation().transpose())
          .eval();
  for (auto& [name, p] : face.landmarks) p = moved * p;
}

inline Eigen::Isometry3d some_pose() {
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.rotate(Eigen::AngleAxisd(0.6, Vec3(1, -2, 0.5).normalized()));
  pose.translation() = Vec3(0.11, -0.4, 0.8);
  return pose;
}

inline void roughen(Points& points, double deviation_m, std::mt19937& generator) {
  std::normal_distribution<double> noise(0, deviation_m);
  for (Eigen::Index i = 0; i < points.size(); ++i) points.data()[i] += noise(generator);
}

}  // namespace hyperex::metrics::testing
