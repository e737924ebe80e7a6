// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::motion {

/// Named points over time, in metres. All sources of motion produce this type, and the rest of the
/// program uses only this type. Immutable by convention: each operation returns a new one.
struct Motion {
  /// Marked points are sampled densely enough up to this step for a curve that goes on smoothly
  /// from one sample to the next (MotionCurve).
  static constexpr double kSmoothUpTo_s = 0.1;
  std::vector<std::string> names;  ///< P of them, unique, e.g. "ibug68_48"
  std::vector<double> time_s;      ///< N of them, strictly rising
  std::vector<Points> positions;   ///< N times P x 3, metres; a row of NaN where not measured
  Triangles triangles;             ///< of the tracked mesh over the P points; may be empty
  /// N poses reference_from_head where the head pose has been removed from `positions` (which then
  /// are in the face's frame); empty where it has not been removed.
  std::vector<Eigen::Isometry3d> head_pose;
  /// The points that were stated to move with the skull alone when the head pose was removed; empty
  /// where none were stated.
  std::vector<std::string> skull_points;
  /// Where two samples are farther apart than this, no coordinate leaves the range of their values
  /// between them (MotionCurve). 0 for points that weights of expressions move.
  double smooth_up_to_s = kSmoothUpTo_s;
  std::vector<int> lines;  ///< line of `source` of each sample, for errors; empty where not known
  std::string source;      ///< what to name in errors: the file, or empty
  std::string unit_note;   ///< which length unit was read and why, for the log

  int index_of(const std::string& name) const;  ///< -1 where there is none
  /// All points at time t: linear between samples. Before the first and after the last sample, that
  /// sample's positions.
  Points at(double t) const;
};

/// The motion without the samples after `end_s`. `option`: the name of that option in errors.
/// Throws InputError if fewer than two samples are left.
Motion until(Motion motion, double end_s, const std::string& option);

/// The name used in errors: `source`, or "motion" where that is empty.
std::string named(const Motion& motion);
/// Throws InputError in one line, "SOURCE: message".
[[noreturn]] void refuse(const Motion& motion, const std::string& message);

}  // namespace hyperex::motion
