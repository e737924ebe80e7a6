// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "hyperex/geometry/types.hpp"
#include "hyperex/report/page_data.hpp"

namespace hyperex::studio {

/// Puts displacements into `block`: "step_m" and "values" of the events shape and live_shape.
void add_shape(const PointsF& displacement_m, report::BinaryBlock& block, nlohmann::json& head);

}  // namespace hyperex::studio
