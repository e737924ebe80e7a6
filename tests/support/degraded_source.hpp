// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A recording with added faults, always the same.
#include <cstddef>
#include <memory>

#include "hyperex/capture/source.hpp"

namespace hyperex::test {

/// A range of frames, by their index in the source.
struct FrameSpan {
  std::size_t first = 0, count = 0;
  bool holds(std::size_t index) const { return index >= first && index - first < count; }
};

/// The faults of a recording, applied in this order.
struct Degradation {
  bool without_depth = false;
  double depth_holes = 0;   ///< share (0 to 1) of the depth pixels without a reading
  double brightness = 1;    ///< factor on the colour, 0 to 1
  double noise_levels = 0;  ///< noise added to each channel: standard deviation, of 255
  FrameSpan black = {};     ///< frames with black colour; their depth stays
  /// Frames in which the picture slides out to the right, stays out and comes back, a third of them
  /// each. The background is grey and has no depth.
  FrameSpan away = {};

  /// Whether a frame shows the face at another place than the recording, or not at all.
  bool spoils(std::size_t index) const { return black.holds(index) || away.holds(index); }
};

/// The frames of `source` with `degradation` applied. Noise and holes depend on the frame's index
/// alone.
std::unique_ptr<capture::FrameSource> degraded(std::unique_ptr<capture::FrameSource> source,
                                               const Degradation& degradation);

}  // namespace hyperex::test
