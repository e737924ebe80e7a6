// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// A track after low-pass filtering, and its rate of change.
struct SmoothTrack {
  Points value;  ///< N x 3, unit of the input; NaN where that is not measured
  Points rate;   ///< N x 3, unit of the input per second
};

/// Low-pass filter by the cubic smoothing spline, which minimises
///   sum_i h_i |y_i - f(t_i)|^2 + (2 pi cutoff_hz)^-4 integral |f''|^2 dt,
/// where h_i is the time interval that sample i represents. The filter has no phase shift and
/// allows any times and gaps. Far from the ends its response is 1 / (1 + (f / cutoff)^4), one half
/// at the cut-off. This is the response of a second-order Butterworth filter run forwards and
/// backwards. C. H. Reinsch, Numerische Mathematik 10 (1967) 177; H. J. Woltring, Human Movement
/// Science 4 (1985) 229. `time_s` must increase strictly; `track` has one row per time. Rows of NaN
/// are gaps, which the spline bridges. `cutoff_hz` > 0; with 0, the track is not smoothed and the
/// rates are central differences. Fewer than three measured samples are returned unchanged. Rates
/// within `end_margin_s(cutoff_hz)` of an end depend on samples on one side only and are less
/// accurate.
SmoothTrack lowpassed(const std::vector<double>& time_s, const Points& track, double cutoff_hz);

/// The same for many tracks with the same times. The equations are factored once for all tracks
/// without gaps.
class LowpassFilter {
 public:
  LowpassFilter(std::vector<double> time_s, double cutoff_hz);
  ~LowpassFilter();
  SmoothTrack operator()(const Points& track) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The positions of one point of a motion over time, N x 3, m.
Points track_of(const Motion& motion, int column);

/// All tracks of a motion; with a cut-off of 0 the motion as it is.
Motion lowpassed(Motion motion, double cutoff_hz);

/// The standard deviation of a filtered sample if the track is white noise of standard deviation 1;
/// 1 for a cut-off of 0 and for fewer than three samples. `time_s`: of the measured samples. The
/// filter is linear. Its matrix S fulfils S' W = W S with the diagonal matrix W of the h_i, so that
/// the row of a sample follows from the response to an impulse there. Two periods of the cut-off to
/// either side are enough: the response falls as exp(-4.4 cutoff_hz |t|).
double lowpassed_noise(const std::vector<double>& time_s, std::size_t sample, double cutoff_hz);

/// Half a period of the cut-off frequency, s; 0 for a cut-off of 0.
double end_margin_s(double cutoff_hz);

/// The largest of `values`, NaN excluded, at least end_margin_s() from both ends. If there is none,
/// the largest of all values; NaN if there is none at all.
double greatest_inside(const std::vector<double>& time_s, const std::vector<double>& values,
                       double cutoff_hz);

}  // namespace hyperex::motion
