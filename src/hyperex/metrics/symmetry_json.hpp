// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Separate from the tables, so that programs that use only those need no JSON library.
#include <nlohmann/json.hpp>

#include "hyperex/metrics/symmetry_tables.hpp"

namespace hyperex::metrics {

/// The entry for summary.json: jitter, mesh floor, the undecided share of S(t), commissure,
/// excursions, map. Undefined numbers are null, and so is "undecided" (and "path_undecided" and so
/// on) where a figure is above its floors but not all noise is known (PairExcursion::decided).
nlohmann::ordered_json summary_of(const SymmetryMeasures& measures);

/// The entry "commissure" of the former: the corners of the mouth; null where they are not
/// measured.
nlohmann::ordered_json commissure_json(const Excursions& excursions);

}  // namespace hyperex::metrics
