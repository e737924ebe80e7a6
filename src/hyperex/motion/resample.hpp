// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

enum class Interpolation {
  linear,  ///< velocity jumps at the samples
  /// Cubic with the slopes of bounded_slopes() by Motion::smooth_up_to_s. A motion that starts from
  /// rest and is held after its last sample has no jump of velocity anywhere.
  cubic
};

/// First derivatives, at the rising times `t`, of the C2 cubic splines through the columns of `y`
/// (one row per time). The derivatives at both ends are zero.
Eigen::MatrixXd spline_slopes(const std::vector<double>& t, const Eigen::MatrixXd& y);

/// Those slopes, bounded beside steps of more than `smooth_up_to_s`: there a column stays within
/// the range of the two samples between them. At a sample beside such a step the slope is 0 where
/// the column turns or is held. Elsewhere it is at most three times the lesser of the two mean
/// slopes beside it (Fritsch and Carlson, SIAM J. Numer. Anal. 17, 1980). The second derivative may
/// jump at these samples; away from them the columns are C2.
Eigen::MatrixXd bounded_slopes(const std::vector<double>& t, const Eigen::MatrixXd& y,
                               double smooth_up_to_s);

/// The positions of a motion as functions of time: built once, evaluated often. Before the first
/// and after the last sample, that sample is held.
class MotionCurve {
 public:
  /// Throws InputError where a position is NaN (fill gaps first) or there are no samples.
  explicit MotionCurve(const Motion& motion, Interpolation interpolation = Interpolation::cubic);
  Points at(double t_s) const;

 private:
  std::vector<double> time_s_;
  Eigen::MatrixXd value_, slope_;  // N x 3P; slope empty for linear
};

/// The motion at other times (strictly rising): positions by `interpolation`; head poses by
/// spherical linear interpolation.
Motion resample(const Motion& motion, const std::vector<double>& time_s,
                Interpolation interpolation = Interpolation::cubic);

}  // namespace hyperex::motion
