// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/remesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// x -> centre + r^2 (x - centre) / |x - centre|^2. It is its own inverse and reverses orientation.
Vec3 inverted(const Vec3& x, const Vec3& centre, double r2) {
  const Vec3 d = x - centre;
  return centre + d * (r2 / d.squaredNorm());
}
/// Remeshing would round off the borders: the corners of a slit would retract and its rims would
/// sag. Therefore some vertices are held on every border except the longest (that is, on mouth and
/// eyes): the two that are farthest apart and, between them, about one per `edge_m`.
std::vector<int> held_on_borders(const TriMesh& mesh, double edge_m) {
  std::vector<int> held;
  const auto loops = boundary_loops(mesh.triangles);
  const auto longest = std::max_element(
      loops.begin(), loops.end(), [](const auto& a, const auto& b) { return a.size() < b.size(); });
  for (auto loop = loops.begin(); loop != loops.end(); ++loop) {
    if (loop == longest) continue;
    const std::size_t n = loop->size();
    const auto at = [&](std::size_t i) { return Vec3(mesh.points.row((*loop)[i % n])); };
    std::size_t first = 0, second = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = i + 1; j < n; ++j)
        if ((at(i) - at(j)).squaredNorm() > (at(first) - at(second)).squaredNorm()) {
          first = i;
          second = j;
        }
    if ((at(first) - at(second)).norm() < 2 * edge_m) continue;
    for (const auto& [from, to] : {std::pair{first, second}, std::pair{second, first + n}}) {
      double length = 0, passed = 0;
      for (std::size_t i = from; i < to; ++i) length += (at(i + 1) - at(i)).norm();
      const double step = length / std::max(1.0, std::round(length / edge_m));
      double next = 0;
      for (std::size_t i = from; i < to; ++i) {
        const double edge = (at(i + 1) - at(i)).norm();
        // The vertex closest to the next station.
        if (passed + 0.5 * edge > next && next < length - 0.5 * step) {
          held.push_back((*loop)[i % n]);
          while (next < passed + 0.5 * edge) next += step;
        }
        passed += edge;
      }
    }
  }
  return held;
}

}  // namespace

TriMesh remesh_graded(const TriMesh& mesh, const GradedSize& size, int iterations) {
  const double r2 = (size.focus - size.centre).squaredNorm();
  SurfaceMesh surface;
  TriMesh even = mesh;  // after the inversion, the required size is uniform
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const Vec3 p = inverted(mesh.points.row(v), size.centre, r2);
    even.points.row(v) = p.transpose();
    surface.add_vertex({p.x(), p.y(), p.z()});
  }
  using V = SurfaceMesh::Vertex_index;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    surface.add_face(V(mesh.triangles(f, 0)), V(mesh.triangles(f, 1)), V(mesh.triangles(f, 2)));
  auto held = surface.add_property_map<V, bool>("v:held", false).first;
  for (int v : held_on_borders(even, size.edge_m)) held[V(v)] = true;
  namespace pmp = CGAL::Polygon_mesh_processing;
  pmp::isotropic_remeshing(surface.faces(), size.edge_m, surface,
                           pmp::parameters::number_of_iterations(iterations)
                               .number_of_relaxation_steps(3)
                               .vertex_is_constrained_map(held)
                               .relax_constraints(false));
  surface.collect_garbage();

  TriMesh out;
  out.points.resize(static_cast<Eigen::Index>(surface.number_of_vertices()), 3);
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    out.points.row(v.idx()) = inverted({p.x(), p.y(), p.z()}, size.centre, r2).transpose();
  }
  out.triangles.resize(static_cast<Eigen::Index>(surface.number_of_faces()), 3);
  for (const auto f : surface.faces()) {
    int k = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
      out.triangles(f.idx(), k++) = static_cast<int>(v.idx());
  }
  return out;
}

}  // namespace hyperex
