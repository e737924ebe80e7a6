// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/remesh.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Joins the ends of border edges shorter than `least_share` of the wanted size, the shortest
/// first. Of the two the one stays at which the border turns more, so that the end of a slit keeps
/// its place. Edges whose removal would fold a triangle over (turn its normal by more than 60
/// degrees) or change the topology stay. Where a border changes its position from one node to the
/// next, an edge that is much shorter than its neighbours is stretched that much more.
/// `mesh`: manifold, oriented. Returns the number of edges removed.
int remove_short_border_edges(TriMesh& mesh, const GradedSize& size, double least_share);

}  // namespace hyperex
