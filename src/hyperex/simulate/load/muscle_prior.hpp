// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/muscles/muscle_lines.hpp"
#include "hyperex/simulate/load/muscle_fit.hpp"
#include "hyperex/simulate/options.hpp"

namespace hyperex::simulate {

/// The prior of the activations of `lines`: the options' standard deviations times each muscle's
/// readiness, and correlations
///
///   corr(a, b) = together(a, b) x (on one side ? 1 : side_correlation),   together(a, a) = 1
///
/// `together`: of the table's rows; named by either of the two muscles. The matrix over both sides
/// is the Kronecker product of that of one side and [1 c; c 1], hence positive definite where that
/// of one side is. Throws InputError where it is not: correlations that cannot hold together.
FitPriors muscle_prior(const std::vector<muscles::MuscleLine>& lines, const MuscleOptions& options);

}  // namespace hyperex::simulate
