// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// How far a response trails its input.
struct Lag {
  double lag_s = 0;        ///< response(t) is most like input(t - lag): positive where it trails
  double correlation = 0;  ///< Pearson's at that lag
  bool at_limit = false;   ///< the best lag is the largest looked at: there may be a better one
};

/// Cross-correlation below the step of sampling: the response is interpolated by the C2 cubic
/// spline at rest at both ends (motion/resample.hpp), and Pearson's correlation of input(t_k) and
/// response(t_k + lag) over the samples for which t_k - most and t_k + most lie within the signals
/// is maximised over |lag| <= most: on a grid of a quarter of the median step, then by parabolas
/// through three lags ever closer. A signal shifted by 0.37 steps is found to 0.001 steps where it
/// has 15 samples a period or more (lag_test.cpp). Times strictly rise and are common to both.
/// NaN where fewer than eight samples are left or a signal does not vary. Throws
/// std::invalid_argument where sizes differ or most_lag_s is not above 0.
Lag lag_of(const std::vector<double>& time_s, const std::vector<double>& input,
           const std::vector<double>& response, double most_lag_s = 0.1);

/// Area that the curve of response over input encloses, closed by a straight line from its end to
/// its start, over the area of the box about it:
///   H = |1/2 sum_k (i_k r_k+1 - i_k+1 r_k)| / ((max i - min i) (max r - min r)).
/// 0: the response depends on the input alone. For harmonic signals H = pi/4 sin(delta), with
/// delta the phase by which the response trails (the ellipse of a linear viscoelastic body: R.
/// Lakes, Viscoelastic Materials, Cambridge University Press, 2009). A loop run through n times
/// counts n times. NaN where a signal does not vary. Throws std::invalid_argument where sizes
/// differ.
double hysteresis_of(const std::vector<double>& input, const std::vector<double>& response);

/// The displacement of a moving point as one signal, m: its component along the direction in which
/// it is farthest from where it first was. `positions` N x 3, finite. Zeros where it never moves.
std::vector<double> along_farthest(const Points& positions);

}  // namespace hyperex::metrics
