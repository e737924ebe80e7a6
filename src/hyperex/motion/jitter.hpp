// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// The standard deviation of a coordinate's jitter (m): the median absolute fourth difference of
/// all `columns`, divided by 0.6745 sqrt(70). A smooth motion has almost no fourth differences. 0
/// for fewer than five samples.
double jitter_of_differences(const Motion& motion, const std::vector<int>& columns);

/// The same where the face may move all the time: the contribution of the motion to the differences
/// is removed. White noise of standard deviation s has fourth differences of variance C(8, 4) s^2 =
/// 70 s^2, whether taken over neighbouring samples or over every second one. The fourth differences
/// of a smooth motion grow with the fourth power of the step. Let d_1 and d_2 be the median
/// absolute fourth differences of neighbouring samples and of every second sample, divided by
/// 0.6745 sqrt(70). Then
///   s^2 = (4^4 d_1^2 - d_2^2) / (4^4 - 1),  at least 0,
/// where d^2 is the mean over `columns` and axes. Differences of a time series are used as in the
/// estimator of Rice (Annals of Statistics 12 (1984) 1215) and its higher orders (Hall, Kay and
/// Titterington, Biometrika 77 (1990) 521); the median absolute deviation makes it robust to
/// outliers. At uneven times divided differences are used, scaled to the same variance.
///
/// Limits: the noise must be white. If noise has passed the low-pass filter of lowpass.hpp with a
/// cut-off of 0.4, 0.2 or 0.1 times the sampling rate, the estimate is 60, 16 or 2 % of the noise
/// that remains: a smoothed recording looks exact. Errors that last over many samples are not
/// detected either. A face without jitter that shakes all the time at 3 Hz by 5 mm, sampled at 30
/// Hz, gives 0.05 mm. NaN for fewer than 20 samples, or where no point is measured for long enough.
double jitter_of_motion(const Motion& motion, const std::vector<int>& columns);

}  // namespace hyperex::motion
