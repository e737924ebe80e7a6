// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of a face that is tracked live, transferred to a scan in the same way as those of a
// recording in a run.
#include <deque>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/expressive_pose.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::studio {

/// The positions of named points in one frame, as tracked.
struct LiveSample {
  double time_s = 0;
  Points positions;  ///< P x 3, m, finite, in the tracker's frame of the head
};

/// Converts samples one after another to displacements from the neutral face, in the scan's frame.
/// The remaining head pose is removed (motion::ExpressivePoseStream). The face at rest is aligned
/// to the scan's landmarks, and displacements are rotated and scaled with it (simulate::align).
class LiveMotion {
 public:
  /// The neutral face is the mean of `neutral` (at least one sample), from which the jitter is
  /// estimated too. Throws InputError as simulate::align() does.
  LiveMotion(std::vector<std::string> names, const std::deque<LiveSample>& neutral,
             io::Landmarks landmarks, simulate::AlignmentMethod method);

  const Points& neutral() const { return neutral_; }
  /// The points at rest in two samples, `interval_s` apart, with which a Simulator starts.
  simulate::AlignedMotion at_rest(double interval_s) const;
  /// Displacements from rest, P x 3, m, scan frame. Times must rise from call to call.
  Points displacement(const LiveSample& sample);

 private:
  std::vector<std::string> names_;
  Points neutral_;
  io::Landmarks landmarks_;
  simulate::AlignmentMethod method_;
  motion::ExpressivePoseStream poses_;
};

/// A recorded take as the motion of a scene: the samples from `from_s` to `to_s` after the first,
/// without head pose, starting at rest, that is, with the neutral face (motion::with_rest). Throws
/// InputError where fewer than two samples are left.
motion::Motion motion_of_take(const std::vector<std::string>& names,
                              const std::vector<LiveSample>& samples, const Points& neutral,
                              double from_s, double to_s);

}  // namespace hyperex::studio
