// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::anatomy {

/// Landmarks in other axes than the scan's (LPS and RAS exchanged, a mirrored export) may by chance
/// lie near its skin and agree with each other. The canonical face, laid on them by a similarity,
/// then does not fit the scan: the median distance of its vertices from the skin is 3 mm and more,
/// and 1.5 mm where the landmarks are in the scan's axes. If with some axes negated the landmarks
/// lie within `largest_offset_m` of the skin and the canonical face at most half as far as it does
/// now, returns one sentence with these axes and the probable cause. `canonical`, `given`: the same
/// landmarks on the canonical face and as given, three or more that are not on one line.
std::optional<std::string> negated_axes_problem(const Points& canonical, const Points& given,
                                                const SurfaceTree& scan, double largest_offset_m);

}  // namespace hyperex::anatomy
