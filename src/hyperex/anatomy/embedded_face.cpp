// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/embedded_face.hpp"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

#include "hyperex/core/assert.hpp"
#include "hyperex/face/close_lips.hpp"

namespace hyperex::anatomy {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Surface = CGAL::Surface_mesh<Kernel::Point_3>;

constexpr unsigned kRounds = 2;
// Each correction of the control mesh leaves about a third of the shrinkage.
constexpr int kCorrections = 2;

/// Vertices of the control mesh keep their indices; new ones follow.
TriMesh subdivided(const Points& control, const Triangles& triangles) {
  Surface surface;
  for (Eigen::Index v = 0; v < control.rows(); ++v)
    surface.add_vertex({control(v, 0), control(v, 1), control(v, 2)});
  for (Eigen::Index f = 0; f < triangles.rows(); ++f) {
    using V = Surface::Vertex_index;
    [[maybe_unused]] const auto made = surface.add_face(
        V(unsigned(triangles(f, 0))), V(unsigned(triangles(f, 1))), V(unsigned(triangles(f, 2))));
    HX_ASSERT(made != Surface::null_face());
  }
  CGAL::Subdivision_method_3::Loop_subdivision(surface,
                                               CGAL::parameters::number_of_iterations(kRounds));
  TriMesh mesh;
  mesh.points.resize(Eigen::Index(surface.number_of_vertices()), 3);
  for (const auto v : surface.vertices()) {
    const auto& p = surface.point(v);
    mesh.points.row(Eigen::Index(v.idx())) << p.x(), p.y(), p.z();
  }
  mesh.triangles.resize(Eigen::Index(surface.number_of_faces()), 3);
  Eigen::Index row = 0;
  for (const auto f : surface.faces()) {
    int corner = 0;
    for (const auto v : surface.vertices_around_face(surface.halfedge(f)))
      mesh.triangles(row, corner++) = int(v.idx());
    ++row;
  }
  return mesh;
}

/// Nearly passes through `points`.
TriMesh subdivided_through(const Points& points, const Triangles& triangles) {
  Points control = points;
  TriMesh fine = subdivided(control, triangles);
  for (int round = 0; round < kCorrections; ++round) {
    control += points - fine.points.topRows(points.rows());
    fine = subdivided(control, triangles);
  }
  return fine;
}

}  // namespace

EmbeddedFace embedded_face() {
  const CanonicalFace& face = canonical_face();
  const Triangles triangles = face::opened_triangles(face);
  EmbeddedFace embedded;
  embedded.mesh = subdivided_through(face.mesh.points, triangles);
  face::close_lips(embedded.mesh.points, lip_contour());
  // The places in the picture are divided as the places in space are.
  Points places = Points::Zero(face.uv.rows(), 3);
  places.leftCols<2>() = face.uv.cast<double>();
  embedded.uv = subdivided_through(places, triangles).points.leftCols<2>().cast<float>();
  for (const auto& [name, indices] : face.landmarks) {
    // A landmark that is a mean of vertices is taken to the vertex of the fine mesh nearest to it.
    const Vec3 mean = face.landmark(name, embedded.mesh.points);
    Eigen::Index nearest = 0;
    (embedded.mesh.points.rowwise() - mean.transpose()).rowwise().squaredNorm().minCoeff(&nearest);
    embedded.landmarks[name] = embedded.mesh.points.row(nearest).transpose();
  }
  return embedded;
}

}  // namespace hyperex::anatomy
