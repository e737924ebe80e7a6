// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

enum class Interpolation {
  linear,  ///< velocity jumps at the samples
  /// C2 cubic spline through the samples with zero velocity at both ends. A motion that starts from
  /// rest and is held after its last sample then has no jump of velocity anywhere. May overshoot.
  cubic,
  /// C1 cubic Hermite with the slopes of Fritsch and Butland (SIAM J. Sci. Stat. Comput. 5, 1984).
  /// Between two samples it stays within the range of their values.
  monotone
};

/// First derivatives, at the rising times `t`, of the C2 cubic splines through the columns of `y`
/// (one row per time). The derivatives at both ends are zero.
Eigen::MatrixXd spline_slopes(const std::vector<double>& t, const Eigen::MatrixXd& y);

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
