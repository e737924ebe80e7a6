// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/metrics/symmetry.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::cli {

/// xi of both sides and S over time, one above the other.
render::Image draw(const metrics::SymmetryCurve& curve, const std::string& title);

}  // namespace hyperex::cli
