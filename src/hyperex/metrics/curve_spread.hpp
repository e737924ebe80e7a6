// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/metrics/symmetry.hpp"

namespace hyperex::metrics {

/// xi_L - xi_R with its sign, one value per sample. (S is the logarithm of its absolute value.)
std::vector<double> signed_difference(const SymmetryCurve& curve);

/// xi_L - xi_R of `curve` minus that of `own`, one value per sample. Throws std::invalid_argument
/// if the numbers of samples differ.
std::vector<double> added_difference(const SymmetryCurve& curve, const SymmetryCurve& own);

/// The spread of several curves S(t) of one motion: the greatest S minus the least S, one value per
/// sample. This is the logarithm of the ratio of the |xi_L - xi_R|. NaN if a curve is not measured
/// there, or if its |xi_L - xi_R| is below `clear` times its floor, because near zero S is
/// dominated by rounding. Throws std::invalid_argument if there is no curve or if the numbers of
/// samples differ.
std::vector<double> spread_of(const std::vector<SymmetryCurve>& curves, double clear = 10);

/// The share of the integral of |value| over time that lies between `from_s` and `to_s`. Values are
/// interpolated linearly; an interval between samples with a NaN at either end counts as 0. NaN if
/// the whole integral is 0. Throws std::invalid_argument if the sizes differ.
double share_between(const std::vector<double>& time_s, const std::vector<double>& value,
                     double from_s, double to_s);

/// The sample with the greatest |value|; -1 if all are NaN.
int greatest_sample(const std::vector<double>& value);

}  // namespace hyperex::metrics
