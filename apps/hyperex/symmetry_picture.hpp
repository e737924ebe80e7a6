// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>

#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/render/image.hpp"

namespace hyperex::cli {

/// Draws xi of both sides and S with its noise floor over time, and bars of the excursions of both
/// sides. The bars show at most ten pairs of points: those with the largest excursions. Where the
/// curve is not known(), the bars are drawn alone.
render::Image draw(const metrics::SymmetryMeasures& measures, const std::string& title);

}  // namespace hyperex::cli
