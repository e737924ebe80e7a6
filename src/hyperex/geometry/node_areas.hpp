// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Area of a surface that belongs to each node, m^2: a third of each triangle around it.
Eigen::VectorXd node_areas(const TriMesh& surface);

}  // namespace hyperex
