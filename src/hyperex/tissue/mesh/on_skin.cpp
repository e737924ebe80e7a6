// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/on_skin.hpp"

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"

namespace hyperex::tissue {

TissueMesh with_full_skin(const TissueMesh& mesh) {
  TissueMesh whole = mesh;
  if (!mesh.full) return whole;
  const FullSkin& full = *mesh.full;
  whole.skin = full.skin;
  whole.scan_vertices = full.scan_vertices;
  whole.appended = full.appended;
  whole.source_triangle = full.source_triangle;
  whole.skin_upper_margin.resize(full.places.size());
  for (std::size_t v = 0; v < full.places.size(); ++v) {
    const MeshPlace& place = full.places[v];
    double margin = 0;
    for (int k = 0; k < 3; ++k)
      margin += place.weight[k] * mesh.skin_upper_margin[std::size_t(place.vertex[std::size_t(k)])];
    whole.skin_upper_margin[v] = margin;
  }
  return whole;
}

SideTree skin_tree(const TissueMesh& mesh, const io::Landmarks& landmarks) {
  const Vec3 mouth = face::face_frame(landmarks).origin;
  const double reach = 1.8 * (landmarks.at(face::ibug(54)) - mouth).norm();
  return {mesh.skin, mesh.skin_upper_margin, mouth, reach};
}

TriMesh scan_of(const TissueMesh& mesh) {
  return {mesh.skin.points.topRows(mesh.scan_vertices), mesh.skin.triangles};
}

Eigen::VectorXd on_skin(const TissueMesh& mesh, const Eigen::VectorXd& of_scan) {
  const std::vector<double>& margin = mesh.skin_upper_margin;
  Eigen::VectorXd out(mesh.skin.points.rows());
  out.head(mesh.scan_vertices) = of_scan;
  for (std::size_t i = 0; i < mesh.appended.size(); ++i) {
    const EdgePoint& e = mesh.appended[i];
    const Eigen::Index own = mesh.scan_vertices + Eigen::Index(i);
    double t = e.t;
    if (margin[e.a] * margin[e.b] < 0) t = margin[e.a] * margin[own] > 0 ? 0 : 1;
    // No product with a value that counts for nothing: it may be unknown.
    out[own] = t == 0   ? of_scan[e.a]
               : t == 1 ? of_scan[e.b]
                        : (1 - t) * of_scan[e.a] + t * of_scan[e.b];
  }
  return out;
}

}  // namespace hyperex::tissue
