// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Area of the surface associated with each node, m^2: a third of each adjacent triangle.
Eigen::VectorXd node_areas(const TriMesh& surface);

}  // namespace hyperex
