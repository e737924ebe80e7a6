// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Inside the room.
#include <Eigen/Core>

namespace hyperex::render {

/// Where a ray met a surface.
struct Hit {
  int surface = -1, triangle = -1;
  double weight[3] = {0, 0, 0};                      // barycentric
  Eigen::Vector3f normal = Eigen::Vector3f::Zero();  // of the facet, camera frame, unit
};

}  // namespace hyperex::render
