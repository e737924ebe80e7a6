// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Seams: lines on the skin across which neighbours move with different parts of the simulated
// surface.
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/tissue/mesh/rim.hpp"

namespace hyperex::tissue {

struct Anchor;

/// `rim` with the skin's motion made smooth across seams. At the corners of the mouth the simulated
/// slit ends inside the visible corner, so that the skin between both moves in part with the upper
/// lip and in part with the lower one. Where these separate, such skin would tear: neighbours 1 mm
/// apart by up to 8 mm.
///
/// A seam crosses an edge of the skin if the weights of its ends' nodes differ by more than 1.5 per
/// mm, and by more than 6 per edge length of the simulated surface, summed over nodes; elsewhere
/// the differences are near 0.5 and 2. A difference of more than 1.9 is always a seam: with 2, the
/// ends have no node in common. Edges longer than half of one of the surface are not looked at.
/// Within 4 mm of a seam, along the skin, the displacement x of the skin minimises
///   sum over vertices of area (c (x - x0)^2 + l^4 (laplacian of x)^2),   l = 1 mm,
/// where x0 is the displacement by `rim` and anchors, and c is 1e-6 within 2 mm of the seam and
/// 1 beyond. It is a weighted sum of the nodes' displacements, as before. `anchors`: one per vertex
/// of the skin. Returns `rim` with the vertices near seams changed or added, rising.
std::vector<RimVertex> smooth_seams(const TriMesh& skin, const TriMesh& outer,
                                    const std::vector<Anchor>& anchors, std::vector<RimVertex> rim);

}  // namespace hyperex::tissue
