// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Apart from the tables: other programs use those, and need no JSON library for them.
#include <nlohmann/json.hpp>

#include "hyperex/metrics/symmetry_tables.hpp"

namespace hyperex::metrics {

/// For summary.json: jitter, the mesh's floor, how much of S(t) is undecided, commissure,
/// excursions, map. Numbers that are not defined are null.
nlohmann::ordered_json summary_of(const SymmetryMeasures& measures);

}  // namespace hyperex::metrics
