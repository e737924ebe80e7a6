// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/hole_filling.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/utility.h>

#include <iterator>

namespace hyperex {

bool fill_hole(TriMesh& mesh, const std::vector<int>& loop) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_3> polyline;
  // Opposite to the direction of the border, so that the new triangles are oriented as their
  // neighbours.
  for (auto it = loop.rbegin(); it != loop.rend(); ++it)
    polyline.emplace_back(mesh.points(*it, 0), mesh.points(*it, 1), mesh.points(*it, 2));
  std::vector<CGAL::Triple<int, int, int>> patch;
  CGAL::Polygon_mesh_processing::triangulate_hole_polyline(polyline, std::back_inserter(patch));
  if (patch.empty()) return false;
  const auto vertex = [&](int i) { return loop[loop.size() - 1 - static_cast<std::size_t>(i)]; };
  const Eigen::Index old = mesh.triangles.rows();
  mesh.triangles.conservativeResize(old + static_cast<Eigen::Index>(patch.size()), 3);
  for (std::size_t i = 0; i < patch.size(); ++i)
    mesh.triangles.row(old + static_cast<Eigen::Index>(i)) << vertex(patch[i].first),
        vertex(patch[i].second), vertex(patch[i].third);
  return true;
}

}  // namespace hyperex
