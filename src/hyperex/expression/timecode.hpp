// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace hyperex::expression {

/// Decodes a timecode of Live Link Face, "HH:MM:SS:FF.fff": hours, minutes, seconds, frames and
/// thousandths of a frame. Returns one number: 1000 times the whole seconds plus the frames;
/// nothing if the text is not a timecode.
std::optional<double> timecode_frames(std::string_view text);

/// Frames per second, which a timecode does not state: 60 if any frame number reaches 30, else 30
/// if any reaches 24, else 24.
double frame_rate_of(const std::vector<double>& codes);

/// Seconds since midnight.
double timecode_seconds(double code, double rate_hz);

}  // namespace hyperex::expression
