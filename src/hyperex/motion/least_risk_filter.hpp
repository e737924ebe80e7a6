// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

namespace hyperex::motion {

/// Tracks of a recording with white noise, smoothed only as far as that noise asks. The filter is
/// that of lowpass.hpp. Of some cut-offs between `least_hz` and half the sampling rate, and of no
/// filter, the one is taken that minimises the unbiased estimate of the mean squared error,
///   |y - S y|^2 / n + 2 s^2 trace(S) / n - s^2,
/// over all tracks. S: the filter's matrix; s: `noise_m`. G. Wahba, Spline Models for Observational
/// Data (1990), section 4.7 (after C. L. Mallows, Technometrics 15 (1973) 661).
/// A face moves slower than about `least_hz`. Samples that are too far apart for such a cut-off are
/// left as they are, since poses that differ cannot be told from noise there. `tracks`: one column
/// for each of `time_s` (which increase strictly), one row for each coordinate, m. Without noise (0
/// or NaN), or with fewer than 20 times, they are returned as they are.
Eigen::MatrixXd least_risk_filtered(const std::vector<double>& time_s,
                                    const Eigen::MatrixXd& tracks, double noise_m,
                                    double least_hz = 3);

}  // namespace hyperex::motion
