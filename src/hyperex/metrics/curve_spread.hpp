// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/metrics/symmetry.hpp"

namespace hyperex::metrics {

/// xi_L - xi_R, a value per sample, with its sign (S is the logarithm of its size).
std::vector<double> signed_difference(const SymmetryCurve& curve);

/// What `curve` adds to the signed difference of `own`, a value per sample. Throws
/// std::invalid_argument where their numbers of samples differ.
std::vector<double> added_difference(const SymmetryCurve& curve, const SymmetryCurve& own);

/// How far curves S(t) of one motion part: the greatest S less the least, a value per sample; by
/// what factor |xi_L - xi_R| differs, as a logarithm. Where one of the curves is not measured, or
/// its |xi_L - xi_R| is under `clear` times its floor, NaN: near zero S is decided by rounding.
/// Throws std::invalid_argument where there is no curve or their numbers of samples differ.
std::vector<double> spread_of(const std::vector<SymmetryCurve>& curves, double clear = 10);

/// The share of the integral of |value| over time that lies from `from_s` to `to_s`; values are
/// linear between samples, and a stretch with a NaN at either end counts as 0. NaN where the whole
/// integral is 0. Throws std::invalid_argument where sizes differ.
double share_between(const std::vector<double>& time_s, const std::vector<double>& value,
                     double from_s, double to_s);

/// The sample of the greatest |value|; -1 where all are NaN.
int greatest_sample(const std::vector<double>& value);

}  // namespace hyperex::metrics
