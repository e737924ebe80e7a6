// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/time/newmark.hpp"

namespace hyperex::fem {

/// The complete load of a model over a run: r shapes, each multiplied by a function of time,
///   d_c(t) = prescribed s(t),  f(t) = force s(t),  and the same with s' and s''.
struct Drive {
  Eigen::MatrixXd prescribed;       ///< |c| x r, m
  Eigen::MatrixXd force;            ///< 3 |nodes| x r, N; no rows: no force
  Eigen::MatrixXd s, rate, second;  ///< r x (steps + 1): s, s' (1/s), s'' (1/s^2) at step 0, 1, ...

  Eigen::Index shapes() const { return s.rows(); }
  int steps() const { return static_cast<int>(s.cols()) - 1; }
  Kinematics prescribed_at(int step) const {
    return {prescribed * s.col(step), prescribed * rate.col(step), prescribed * second.col(step)};
  }
  Eigen::VectorXd force_at(int step) const {
    return force.rows() > 0 ? Eigen::VectorXd(force * s.col(step)) : Eigen::VectorXd();
  }
};

}  // namespace hyperex::fem
