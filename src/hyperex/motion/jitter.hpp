// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// The standard deviation of a coordinate's jitter (m): median of the absolute fourth differences
/// of all `columns`, over 0.6745 sqrt(70); a smooth motion has next to none. 0 for fewer than five
/// samples.
double jitter_of_differences(const Motion& motion, const std::vector<int>& columns);

/// The same where the face may move all the time, with what the motion itself makes of the
/// differences taken out. White noise of standard deviation s has fourth differences of variance
/// C(8, 4) s^2 = 70 s^2, whether taken over neighbouring samples or over every second one; those of
/// a smooth motion grow with the fourth power of the step. So with d_1 and d_2 the median absolute
/// fourth difference of neighbouring and of every second sample, over 0.6745 sqrt(70),
///   s^2 = (4^4 d_1^2 - d_2^2) / (4^4 - 1),  at least 0,
/// d^2 being the mean over `columns` and axes. Differences of the time series as in the estimator
/// of Rice (Annals of Statistics 12 (1984) 1215) and its higher orders (Hall, Kay and Titterington,
/// Biometrika 77 (1990) 521); the median absolute deviation for outliers' sake. At uneven times
/// they are divided differences, scaled to the same variance.
///
/// Limits: the noise must be white. Of noise that went through the low-pass of lowpass.hpp with a
/// cut-off of 0.4, 0.2 or 0.1 times the sampling rate, 60, 16 and 2 % of what is left of it is
/// seen: a smoothed recording looks exact. Errors that last are not seen either. A face that never
/// stops and shakes at 3 Hz by 5 mm, sampled at 30 Hz, is taken for 0.05 mm.
/// NaN for fewer than 20 samples, or where nothing is measured for long enough.
double jitter_of_motion(const Motion& motion, const std::vector<int>& columns);

}  // namespace hyperex::motion
