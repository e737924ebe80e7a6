// SPDX-License-Identifier: GPL-3.0-or-later
// What `hyperex symmetry` prints.
#pragma once
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/session/recording_jitter.hpp"

namespace hyperex::cli {

/// As many samples as fit on a screen, evenly spaced.
void print_curve(const metrics::SymmetryCurve& curve);
/// One row per pair of points.
void print_excursions(const metrics::Excursions& excursions);
/// The verdict, the jitter it rests on, and the asymmetry of the surface where there is a map.
void print_summary(const metrics::SymmetryMeasures& all, const session::RecordedJitter& jitter);

}  // namespace hyperex::cli
