// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <string>
#include <vector>

#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::estimate {

/// One recording at the peak of its expression, or while a known load acts on a relaxed face.
struct Observation {
  std::string name;
  int load = -1;  ///< of Question::loads; below 0: muscles act
  /// Displacement of the points from rest: x, y, z of each in turn, m.
  Eigen::VectorXd displacement_m;
  double time_s = 0;   ///< of the peak, from the first sample
  int samples = 0;     ///< that the displacement is the mean of
  double noise_m = 0;  ///< 1 sigma of the error of a coordinate
  /// 1 sigma of the error of the head's pose: rad about each axis, m along each.
  double head_turn_rad = 0, head_shift_m = 0;
};

/// Errors of a recording's samples.
struct RecordingErrors {
  double jitter_m = 0;  ///< 1 sigma of a coordinate of a sample
  double head_turn_rad = 0, head_shift_m = 0;
};

/// The recording where its points are farthest from rest (root mean square). Displacements are
/// means over the samples about the peak that are within 5 % of it; noise_m is that of this mean
/// and of the sample at rest. `points`: names, all in the motion. Throws InputError where nothing
/// moves.
Observation observe(const simulate::AlignedMotion& recording,
                    const std::vector<std::string>& points, const RecordingErrors& errors,
                    const std::string& name);

/// The recording while a known load acts: the mean over the last tenth of its samples, and over all
/// that have gone four fifths of the way to these. A recording that hardly moves is not refused,
/// since stiff tissue hardly moves. time_s: of the first such sample.
Observation observe_load(const simulate::AlignedMotion& recording,
                         const std::vector<std::string>& points, const RecordingErrors& errors,
                         const std::string& name);

}  // namespace hyperex::estimate
