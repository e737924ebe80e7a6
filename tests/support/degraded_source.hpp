// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A recording made worse, the same way every time.
#include <cstddef>
#include <memory>

#include "hyperex/capture/source.hpp"

namespace hyperex::test {

/// Frames from `first` on, by their index in the source.
struct FrameSpan {
  std::size_t first = 0, count = 0;
  bool holds(std::size_t index) const { return index >= first && index - first < count; }
};

/// What is done to a recording, in this order.
struct Degradation {
  bool without_depth = false;
  double depth_holes = 0;   ///< share (0 to 1) of the depth's pixels that lose their reading
  double brightness = 1;    ///< factor on the colour, 0 to 1
  double noise_levels = 0;  ///< then added to each channel: standard deviation, of 255
  FrameSpan black = {};     ///< frames whose colour is black; their depth stays
  /// Frames in which the picture slides out to the right, stays out and comes back, a third of them
  /// each; grey and without depth behind it.
  FrameSpan away = {};

  /// Whether a frame shows the face elsewhere than in the recording, or not at all.
  bool spoils(std::size_t index) const { return black.holds(index) || away.holds(index); }
};

/// The frames of `source` with `degradation` done to them. Noise and holes depend on the frame's
/// index alone.
std::unique_ptr<capture::FrameSource> degraded(std::unique_ptr<capture::FrameSource> source,
                                               const Degradation& degradation);

}  // namespace hyperex::test
