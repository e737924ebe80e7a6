// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/simulate/drive/matching.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::simulate {

/// mesh.rim corrected so that driven places (on mesh.skin) move exactly as the anchors by which
/// they are driven. The smooth field of the rim alone would miss them by up to 3 mm. The error at a
/// place is added to the vertices around it with the weight exp(-(path along the skin / 4 mm)^2),
/// solved for all places together. The result is linear in the nodes' displacements, as the field
/// is.
std::vector<tissue::RimVertex> rim_through(const tissue::TissueMesh& mesh,
                                           const std::vector<Match>& places);

}  // namespace hyperex::simulate
