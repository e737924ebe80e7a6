// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex::report {

/// The opacity of the skin at each vertex, so that a face does not end in a sharp cut like a mask.
/// It is 0 at the longest border of the scan and rises smoothly to 1 at 12 mm from the nearest
/// vertex of that border. The borders at eyes and mouth are shorter and do not fade. 1 everywhere
/// if there is no border.
Eigen::VectorXf border_fade(const TriMesh& skin);

}  // namespace hyperex::report
