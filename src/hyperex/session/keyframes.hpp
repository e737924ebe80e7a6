// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <vector>

#include "hyperex/core/note.hpp"
#include "hyperex/motion/motion.hpp"
#include "hyperex/session/reading_warnings.hpp"

namespace hyperex::session {

/// Whether these times (s, rising) are keyframes, set by hand where the face changes, and no
/// samples of a device. A device samples evenly: its steps are whole multiples of the median one
/// within a tenth of it, as it may lose samples. Up to 30 times whose steps are longer than 0.1 s
/// (median) are keyframes
/// - where more than a fifth of the steps are no such multiples, or
/// - where the steps are longer than 0.5 s, slower than any device, and all together shorter than
///   33 s: in milliseconds that would be one frame of a camera. Steps of exactly 1 are those of
///   frame numbers.
/// A slow webcam has uneven steps, too, and more rows.
bool are_keyframes(const std::vector<double>& time_s);

/// `recording.keyframes`: a table of weights has keyframes. Nothing of other readings, whose points
/// move between the samples as well.
std::optional<Note> keyframes_note(const motion::Motion& m, Readings readings);

}  // namespace hyperex::session
