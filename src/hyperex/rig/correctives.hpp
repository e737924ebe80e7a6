// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/expression/correctives.hpp"
#include "hyperex/report/rig_glb.hpp"

namespace hyperex::rig {

/// The combinations of which a rig has correctives if it is asked for them. In these both shapes
/// move the same part of the lips, mostly in opposite directions: an open jaw with closed,
/// funnelled, puckered or smiling lips, and a funnel with a smile. In the order of
/// expression::arkit_shapes(), and so are the two names of each.
const std::vector<expression::ShapePair>& clashing_pairs();

/// The skin's displacement (one row per vertex, m) with ARKit's shapes at weights by name, 0 where
/// a name is missing. A corrective's weight is the product of the weights of its two shapes.
PointsF skin_at(const std::vector<report::RigShape>& shapes,
                const std::map<std::string, double>& weights);

}  // namespace hyperex::rig
