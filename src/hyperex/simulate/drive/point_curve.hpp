// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/motion/resample.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::simulate {

/// The displacement of all the motion's points (P x 3, m) at any time, times `gain`.
class PointCurve {
 public:
  PointCurve(const AlignedMotion& motion, double gain)
      : gain_(gain),
        curve_(motion.motion),
        start_s_(motion.motion.time_s.front()),
        start_(curve_.at(start_s_)) {}
  /// `t_s` from the start of the motion.
  Points at(double t_s) const { return gain_ * (curve_.at(start_s_ + t_s) - start_); }

 private:
  double gain_;
  motion::MotionCurve curve_;
  double start_s_;
  Points start_;
};

}  // namespace hyperex::simulate
