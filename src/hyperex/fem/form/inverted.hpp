// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstdint>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// Of each tetrahedron: 1 where the displacement `d` (|nodes| x 3) turns it inside out or flat,
/// det(I + grad u) <= 0, else 0. Requires tetrahedra of positive volume at rest.
std::vector<std::uint8_t> inverted_tets(const Points& nodes, const Tetrahedra& tets,
                                        const Points& d);

}  // namespace hyperex::fem
