// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// For each tetrahedron: 1 if the displacement `d` (|nodes| x 3) inverts or flattens it, det(I +
/// grad u) <= 0, otherwise 0. All tetrahedra must have positive volume at rest.
std::vector<std::uint8_t> inverted_tets(const Points& nodes, const Tetrahedra& tets,
                                        const Points& d);

}  // namespace hyperex::fem
