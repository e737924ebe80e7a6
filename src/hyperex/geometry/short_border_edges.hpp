// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/remesh.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Collapses border edges shorter than `least_share` of the required size, shortest first. Of the
/// two ends, the one at which the border turns more sharply is kept, so that the end of a slit
/// keeps its position. An edge is not collapsed if this would fold a triangle over (rotate its
/// normal by more than 60 degrees) or change the topology. Reason: where the displacement changes
/// from one border node to the next, an edge that is much shorter than its neighbours would be
/// strained correspondingly more. `mesh` must be manifold and oriented. Returns the number of edges
/// removed.
int remove_short_border_edges(TriMesh& mesh, const GradedSize& size, double least_share);

}  // namespace hyperex
