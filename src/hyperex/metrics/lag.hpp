// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// The delay of a response relative to its input.
struct Lag {
  /// The lag that maximises the correlation of response(t) with input(t - lag); positive: delayed.
  double lag_s = 0;
  double correlation = 0;  ///< Pearson's correlation at that lag
  bool at_limit = false;   ///< the lag is the largest one examined; a greater one may be better
};

/// Finds a lag by cross-correlation, with a resolution finer than the sampling step. The response
/// is interpolated by a C2 cubic spline with zero slope at both ends (motion/resample.hpp).
/// Pearson's correlation of input(t_k) and response(t_k + lag) is maximised over |lag| <=
/// most_lag_s, using the samples for which t_k - most_lag_s and t_k + most_lag_s lie within the
/// signals. The search uses a grid of a quarter of the median step, then parabolas through three
/// increasingly close lags. For a signal with at least 15 samples per period, a shift of 0.37 steps
/// is found to within 0.001 steps (lag_test.cpp). Times must increase strictly and are common to
/// both signals. NaN if fewer than eight samples remain or if a signal is constant. Throws
/// std::invalid_argument if sizes differ or if most_lag_s is not above 0.
Lag lag_of(const std::vector<double>& time_s, const std::vector<double>& input,
           const std::vector<double>& response, double most_lag_s = 0.1);

/// The area enclosed by the curve of response over input, divided by the area of its bounding box:
///   H = |1/2 sum_k (i_k r_k+1 - i_k+1 r_k)| / ((max i - min i) (max r - min r)).
/// The curve is closed by a straight line from its end to its start. H = 0 if the response depends
/// on the input alone. For harmonic signals, H = pi/4 sin(delta), with delta the phase lag of the
/// response (the ellipse of a linear viscoelastic body: R. Lakes, Viscoelastic Materials, Cambridge
/// University Press, 2009). A loop that is traversed n times counts n times. NaN if a signal is
/// constant. Throws std::invalid_argument if sizes differ.
double hysteresis_of(const std::vector<double>& input, const std::vector<double>& response);

/// The displacement of a moving point as a scalar signal, m: its component along the direction of
/// its greatest displacement from the first position. `positions`: N x 3, finite. Zeros if it never
/// moves.
std::vector<double> along_farthest(const Points& positions);

}  // namespace hyperex::metrics
