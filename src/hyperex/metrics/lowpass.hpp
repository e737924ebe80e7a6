// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// A track without what is faster than a cut-off, and its rate of change.
struct SmoothTrack {
  Points value;  ///< N x 3, unit of the input; NaN where that is not measured
  Points rate;   ///< N x 3, unit of the input a second
};

/// The cubic smoothing spline, the minimum of
///   sum_i h_i |y_i - f(t_i)|^2 + (2 pi cutoff_hz)^-4 integral |f''|^2 dt,
/// with h_i the time that sample i stands for. It shifts no phase, takes any times and gaps, and
/// its response far from the ends is 1 / (1 + (f / cutoff)^4): that of a Butterworth filter of
/// second order run forwards and backwards (one half at the cut-off). C. H. Reinsch, Numerische
/// Mathematik 10 (1967) 177; H. J. Woltring, Human Movement Science 4 (1985) 229. `time_s` rises
/// strictly, `track` has a row each; rows of NaN are gaps, over which the spline runs. `cutoff_hz`
/// > 0, or 0: not smoothed, the rates are central differences. Fewer than three measured samples
/// stay as they are.
/// Rates within `end_margin_s(cutoff_hz)` of an end rest on one side alone and jitter more.
SmoothTrack lowpassed(const std::vector<double>& time_s, const Points& track, double cutoff_hz);

/// Half a period of the cut-off; 0 for 0.
double end_margin_s(double cutoff_hz);

/// The largest of `values` (NaN ones aside) that lie end_margin_s() or more from both ends; of all
/// of them where none does. NaN where there is none.
double greatest_inside(const std::vector<double>& time_s, const std::vector<double>& values,
                       double cutoff_hz);

}  // namespace hyperex::metrics
