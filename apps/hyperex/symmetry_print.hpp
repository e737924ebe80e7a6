// SPDX-License-Identifier: GPL-3.0-or-later
// The text output of `hyperex symmetry`.
#pragma once
#include "hyperex/metrics/symmetry_tables.hpp"
#include "hyperex/motion/stabilise.hpp"
#include "hyperex/session/recording_jitter.hpp"

namespace hyperex::cli {

/// Prints as many evenly spaced samples as fit on a screen.
void print_curve(const metrics::SymmetryCurve& curve);
/// One row per pair of points, first those that a clinician reads first.
void print_excursions(const metrics::Excursions& excursions);
/// One line: the pose that was taken out, at its most uncertain; nothing where it was kept. No
/// noise in the points that hold it says nothing of its error, unless the points are known to be
/// exact.
void print_head_uncertainty(const motion::StabilisedMotion& steady,
                            const session::RecordedJitter& jitter);
/// The verdict, the jitter it rests on, and the asymmetry of the surface where there is a map.
/// `doubtful`: as of run::corners_line.
void print_summary(const metrics::SymmetryMeasures& all, const session::RecordedJitter& jitter,
                   bool doubtful);

}  // namespace hyperex::cli
