// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The parts of the skin that extend over a hole of the simulated surface: the rims of lips, lids
// and nostrils.
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::tissue {

struct Anchor;

/// A vertex of the skin that moves as a weighted sum of outer nodes' displacements.
struct RimVertex {
  int vertex = -1;             ///< of the skin
  std::vector<int> node;       ///< outer nodes
  std::vector<double> weight;  ///< one each; sum 1
};

/// The vertices of the skin around the holes of the simulated surface. That surface is coarse and
/// ends before a thin rim does. Many vertices of the rim therefore have the same closest point on
/// it, and neighbours with different closest points would separate when the opening widens. These
/// vertices move by an affine field fitted to the displacements of the nodes around, by weighted
/// least squares (moving least squares: Lancaster and Salkauskas, Math. Comp. 37, 1981, 141).
/// Distances are measured along the skin, so that lips that touch at rest do not carry each other.
/// The field alone moves vertices within 2 mm of the rim and those that extend beyond the surface's
/// border by 1 mm. It fades to the anchor alone at 5 mm from the rim. `anchors`: one per vertex of
/// the skin; `on_border`: per outer node, whether it is on the outer border, where nothing is
/// fitted.
std::vector<RimVertex> rim_vertices(const TriMesh& skin, const TriMesh& outer,
                                    const std::vector<Anchor>& anchors,
                                    const std::vector<char>& on_border);

}  // namespace hyperex::tissue
