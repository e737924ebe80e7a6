// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Points of a face that is tracked live, brought to a scan as a run brings those of a recording.
#include <deque>
#include <string>
#include <vector>

#include "hyperex/io/landmarks.hpp"
#include "hyperex/motion/expressive_pose.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/simulate/drive/alignment.hpp"

namespace hyperex::studio {

/// What a tracker sees of named points in one frame.
struct LiveSample {
  double time_s = 0;
  Points positions;  ///< P x 3, m, finite, in the head's frame as the tracker has it
};

/// Takes samples one after the other to displacements since the neutral face in the scan's frame:
/// what is left of the head's pose is taken out (motion::ExpressivePoseStream), the face at rest is
/// aligned to the scan's landmarks and displacements are turned and scaled with it
/// (simulate::align).
class LiveMotion {
 public:
  /// The neutral face is the mean of `neutral`, of which the jitter is taken too; at least one.
  /// Throws InputError as simulate::align().
  LiveMotion(std::vector<std::string> names, const std::deque<LiveSample>& neutral,
             io::Landmarks landmarks, simulate::AlignmentMethod method);

  const Points& neutral() const { return neutral_; }
  /// The points at rest, twice, `interval_s` apart: what a Simulator begins with.
  simulate::AlignedMotion at_rest(double interval_s) const;
  /// Displacements since rest, P x 3, m, scan frame. Times rise.
  Points displacement(const LiveSample& sample);

 private:
  std::vector<std::string> names_;
  Points neutral_;
  io::Landmarks landmarks_;
  simulate::AlignmentMethod method_;
  motion::ExpressivePoseStream poses_;
};

/// A recorded take as the motion of a scene: samples from `from_s` to `to_s` after the first, head
/// pose out, beginning at rest, which is the neutral face (motion::with_rest). Throws InputError
/// where fewer than two samples are left.
motion::Motion motion_of_take(const std::vector<std::string>& names,
                              const std::vector<LiveSample>& samples, const Points& neutral,
                              double from_s, double to_s);

}  // namespace hyperex::studio
