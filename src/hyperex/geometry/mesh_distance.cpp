// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/mesh_distance.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {

using Eigen::Index;

MeshDistance::MeshDistance(TriMesh closed) : mesh_(std::move(closed)), tree_(mesh_) {
  if (!boundary_loops(mesh_.triangles).empty())
    throw std::invalid_argument("mesh distance: the mesh has a border");
  low_ = mesh_.points.colwise().minCoeff();
  high_ = mesh_.points.colwise().maxCoeff();
  of_triangle_.resize(mesh_.triangles.rows(), 3);
  of_corner_ = Points::Zero(mesh_.points.rows(), 3);
  for (Index f = 0; f < mesh_.triangles.rows(); ++f) {
    const Vec3 a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
    const Vec3 normal = (b - a).cross(c - a).normalized();
    of_triangle_.row(f) = normal;
    for (int k = 0; k < 3; ++k) {
      const Vec3 to = (corner(f, (k + 1) % 3) - corner(f, k)).normalized();
      const Vec3 from = (corner(f, (k + 2) % 3) - corner(f, k)).normalized();
      of_corner_.row(mesh_.triangles(f, k)) +=
          std::acos(std::clamp(to.dot(from), -1.0, 1.0)) * normal.transpose();
      of_edge_.try_emplace(edge_key(f, k), Vec3::Zero()).first->second += normal;
    }
  }
}

bool MeshDistance::may_hold(const Vec3& place) const {
  return (place.array() > low_.array()).all() && (place.array() < high_.array()).all();
}

double MeshDistance::at(const Vec3& place, double within) const {
  const ClosestPoint near = tree_.query(place, within * (1 + 1e-9) + 1e-12);
  const double distance = std::sqrt(near.squared_distance);
  return (place - near.point).dot(normal_at(near)) < 0 ? -distance : distance;
}

Vec3 MeshDistance::corner(Index triangle, int k) const {
  return mesh_.points.row(mesh_.triangles(triangle, k));
}

std::pair<int, int> MeshDistance::edge_key(Index triangle, int k) const {
  return std::minmax({mesh_.triangles(triangle, k), mesh_.triangles(triangle, (k + 1) % 3)});
}

Vec3 MeshDistance::normal_at(const ClosestPoint& near) const {
  constexpr double on = 1e-9;
  const Index f = near.triangle;
  for (int k = 0; k < 3; ++k)
    if (near.weights[k] > 1 - on) return of_corner_.row(mesh_.triangles(f, k));
  for (int k = 0; k < 3; ++k)
    if (near.weights[(k + 2) % 3] < on) return of_edge_.at(edge_key(f, k));
  return of_triangle_.row(f);
}

}  // namespace hyperex
