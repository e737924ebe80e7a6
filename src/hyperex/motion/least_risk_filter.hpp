// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Core>
#include <vector>

namespace hyperex::motion {

/// Removes white noise from tracks by the low-pass filter of lowpass.hpp, with the cut-off that
/// minimises the estimated error. Cut-offs from half the sampling rate down to `least_hz` are
/// compared, and no filtering at all. The error is the unbiased estimate of the mean squared error
/// over all tracks,
///   |y - S y|^2 / n + 2 s^2 trace(S) / n - s^2,
/// with the filter's matrix S and s = `noise_m`. G. Wahba, Spline Models for Observational Data
/// (1990), section 4.7 (after C. L. Mallows, Technometrics 15 (1973) 661).
/// Cut-offs below `least_hz` are not compared, since they would remove motion of the face. So
/// tracks that are sampled at less than 2 `least_hz` are returned unchanged: at such a rate,
/// changes of the pose cannot be distinguished from noise.
/// `tracks`: a row for each coordinate (x, y, z of each point in turn), a column for each of
/// `time_s`, which increase strictly; m. They are returned unchanged, too, for a noise of 0 or NaN,
/// and for fewer than 20 times.
Eigen::MatrixXd least_risk_filtered(const std::vector<double>& time_s,
                                    const Eigen::MatrixXd& tracks, double noise_m,
                                    double least_hz = 3);

}  // namespace hyperex::motion
