// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/close_mesh.hpp"

#include <algorithm>
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/directed_edges.hpp"
#include "hyperex/geometry/hole_filling.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

using Eigen::Index;

/// No edge is run through twice in one direction.
bool oriented(const Triangles& triangles) {
  DirectedEdges edges(3 * static_cast<std::size_t>(triangles.rows()));
  for (Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (!edges.insert(triangles(f, k), triangles(f, (k + 1) % 3))) return false;
  return true;
}

double length_of(const std::vector<int>& loop, const Points& points) {
  double sum = 0;
  for (std::size_t i = 0; i < loop.size(); ++i)
    sum += (points.row(loop[(i + 1) % loop.size()]) - points.row(loop[i])).norm();
  return sum;
}

double enclosed(const TriMesh& mesh) {
  const Eigen::RowVector3d middle = mesh.points.colwise().mean();
  double sum = 0;
  for (Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)) - middle;
    const Vec3 b = mesh.points.row(mesh.triangles(f, 1)) - middle;
    const Vec3 c = mesh.points.row(mesh.triangles(f, 2)) - middle;
    sum += a.dot(b.cross(c));
  }
  return sum / 6;
}

}  // namespace

Closing close_mesh(TriMesh& mesh) {
  Closing out;
  if (mesh.triangles.rows() == 0) {
    out.why_not = "it has no triangles";
    return out;
  }
  if (!oriented(mesh.triangles)) mesh = clean_mesh(mesh).mesh;
  for (const std::vector<int>& loop : boundary_loops(mesh.triangles)) {
    const double length = length_of(loop, mesh.points);
    if (!fill_hole(mesh, loop)) {
      out.why_not = "it has a border that cannot be filled";
      return out;
    }
    ++out.borders;
    out.longest_m = std::max(out.longest_m, length);
  }
  if (!oriented(mesh.triangles) || !boundary_loops(mesh.triangles).empty()) {
    out.why_not = "its borders touch each other";
    return out;
  }
  if (enclosed(mesh) < 0) mesh.triangles.col(1).swap(mesh.triangles.col(2));
  return out;
}

}  // namespace hyperex
