// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/node_areas.hpp"

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {

Eigen::VectorXd node_areas(const TriMesh& surface) {
  Eigen::VectorXd areas = Eigen::VectorXd::Zero(surface.points.rows());
  const Eigen::VectorXd triangles = triangle_areas(surface);
  for (Eigen::Index f = 0; f < triangles.size(); ++f)
    for (int k = 0; k < 3; ++k) areas[surface.triangles(f, k)] += triangles[f] / 3;
  return areas;
}

}  // namespace hyperex
