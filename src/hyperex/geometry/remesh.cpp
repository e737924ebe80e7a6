// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/remesh.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/remesh.h>
#include <CGAL/Surface_mesh.h>

namespace hyperex {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;

/// x -> centre + r^2 (x - centre) / |x - centre|^2, its own inverse; mirrors orientation.
Vec3 inverted(const Vec3& x, const Vec3& centre, double r2) {
  const Vec3 d = x - centre;
  return centre + d * (r2 / d.squaredNorm());
}
}  // namespace

TriMesh remesh_graded(const TriMesh& mesh, const GradedSize& size, int iterations) {
  const double r2 = (size.focus - size.centre).squaredNorm();
  SurfaceMesh surface;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const Vec3 p = inverted(mesh.points.row(v), size.centre, r2);
    surface.add_vertex({p.x(), p.y(), p.z()});
  }
  using V = SurfaceMesh::Vertex_index;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    surface.add_face(V(mesh.triangles(f, 0)), V(mesh.triangles(f, 1)), V(mesh.triangles(f, 2)));
  namespace pmp = CGAL::Polygon_mesh_processing;
  pmp::isotropic_remeshing(surface.faces(), size.edge_m, surface,
                           pmp::parameters::number_of_iterations(iterations)
                               .number_of_relaxation_steps(3)
                               .relax_constraints(true));
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
