// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// mesh.rim changed so that driven places (on mesh.skin) move as their anchors do, by which they
/// are driven: the smooth field of the rim alone would pass them by up to 3 mm. What a place is off
/// is added to the vertices around, with exp(-(walk along the skin / 4 mm)^2), coefficients solved
/// for all places together. Linear in the nodes' displacements, like the field itself.
std::vector<tissue::RimVertex> rim_through(const tissue::TissueMesh& mesh,
                                           const std::vector<Match>& places);

}  // namespace hyperex::simulate
