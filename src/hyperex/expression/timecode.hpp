// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace hyperex::expression {

/// Timecodes of Live Link Face, "HH:MM:SS:FF.fff": hours, minutes, seconds, frames and thousandths
/// of a frame. As one number: 1000 times the whole seconds, plus the frames; nothing where the
/// text is none.
std::optional<double> timecode_frames(std::string_view text);

/// Frames a second, which the code does not say: 60 where a frame number reaches 30, else 30 where
/// one reaches 24, else 24.
double frame_rate_of(const std::vector<double>& codes);

/// Seconds since midnight.
double timecode_seconds(double code, double rate_hz);

}  // namespace hyperex::expression
