// SPDX-License-Identifier: GPL-3.0-or-later
// The text output of `hyperex symmetry`.
#pragma once
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/session/recording_jitter.hpp"

namespace hyperex::cli {

/// Prints as many evenly spaced samples as fit on a screen.
void print_curve(const metrics::SymmetryCurve& curve);
/// One row per pair of points.
void print_excursions(const metrics::Excursions& excursions);
/// The verdict, the jitter it rests on, and the asymmetry of the surface where there is a map.
void print_summary(const metrics::SymmetryMeasures& all, const session::RecordedJitter& jitter);

}  // namespace hyperex::cli
