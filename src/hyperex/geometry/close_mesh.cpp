// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/close_mesh.hpp"

#include <algorithm>
#include <stdexcept>
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/directed_edges.hpp"
#include "hyperex/geometry/hole_filling.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

using Eigen::Index;

/// Whether each directed edge is used at most once.
bool oriented(const Triangles& triangles) {
  DirectedEdges edges(3 * static_cast<std::size_t>(triangles.rows()));
  for (Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (!edges.insert(triangles(f, k), triangles(f, (k + 1) % 3))) return false;
  return true;
}

/// Extends the surface beyond a border by a ring of triangles. Returns the outer border of the
/// ring. Its vertices are new, so that the mesh has no other edges between them.
std::vector<int> add_collar(TriMesh& mesh, const std::vector<int>& loop, double width) {
  const auto n = static_cast<Index>(loop.size());
  const auto first = static_cast<int>(mesh.points.rows());
  std::vector<std::vector<int>> around = vertex_triangles(mesh.triangles, mesh.points.rows());
  Points ring(n, 3);
  for (Index i = 0; i < n; ++i) {
    const int v = loop[std::size_t(i)];
    const Vec3 at = mesh.points.row(v);
    const Vec3 along = mesh.points.row(loop[std::size_t((i + 1) % n)]) -
                       mesh.points.row(loop[std::size_t((i + n - 1) % n)]);
    Vec3 out = Vec3::Zero();
    for (const int f : around[std::size_t(v)])
      for (int k = 0; k < 3; ++k) out += at - mesh.points.row(mesh.triangles(f, k)).transpose();
    if (along.squaredNorm() > 0) out -= along * (out.dot(along) / along.squaredNorm());
    ring.row(i) = at + width * out.normalized();
  }
  mesh.points.conservativeResize(first + n, 3);
  mesh.points.bottomRows(n) = ring;
  const Index old = mesh.triangles.rows();
  mesh.triangles.conservativeResize(old + 2 * n, 3);
  std::vector<int> outer;
  for (Index i = 0; i < n; ++i) {
    const int a = loop[std::size_t(i)], b = loop[std::size_t((i + 1) % n)];
    const int c = first + int(i), d = first + int((i + 1) % n);
    mesh.triangles.row(old + 2 * i) << b, a, c;
    mesh.triangles.row(old + 2 * i + 1) << b, c, d;
    outer.push_back(c);
  }
  return outer;
}

/// Fills a hole by fill_hole(). If its triangles reuse existing edges, adds a collar first and
/// fills the hole inside it.
bool fill(TriMesh& mesh, const std::vector<int>& loop, double length) {
  const TriMesh before = mesh;
  if (fill_hole(mesh, loop) && oriented(mesh.triangles)) return true;
  mesh = before;
  const double width = 0.5 * length / double(loop.size());
  return fill_hole(mesh, add_collar(mesh, loop, width)) && oriented(mesh.triangles);
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
  if (!oriented(mesh.triangles)) {
    try {
      mesh = clean_mesh(mesh).mesh;
    } catch (const std::invalid_argument& error) {
      out.why_not = std::string("it ") + error.what();
      return out;
    }
  }
  for (const std::vector<int>& loop : boundary_loops(mesh.triangles)) {
    const double length = loop_length(loop, mesh.points);
    if (!fill(mesh, loop, length)) {
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
