// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/timecode.hpp"

#include <cmath>

#include "hyperex/io/number.hpp"

namespace hyperex::expression {

namespace {
constexpr double kSecond = 1000;  // greater than any number of frames per second
double frames_of(double code) {
  return code - kSecond * std::floor(code / kSecond);
}
}  // namespace

std::optional<double> timecode_frames(std::string_view text) {
  constexpr double limit[4] = {24, 60, 60, kSecond};
  double part[4];
  for (int i = 0; i < 4; ++i) {
    const auto end = i < 3 ? text.find(':') : text.size();
    if (end == std::string_view::npos) return std::nullopt;
    const auto number = io::parse_number(text.substr(0, end));
    if (!number || !(*number >= 0) || *number >= limit[i]) return std::nullopt;
    part[i] = *number;
    text.remove_prefix(std::min(text.size(), end + 1));
  }
  return kSecond * (3600 * part[0] + 60 * part[1] + part[2]) + part[3];
}

double frame_rate_of(const std::vector<double>& codes) {
  double most = 0;
  for (const double code : codes) most = std::max(most, frames_of(code));
  return most >= 30 ? 60 : most >= 24 ? 30 : 24;
}

double timecode_seconds(double code, double rate_hz) {
  return std::floor(code / kSecond) + frames_of(code) / rate_hz;
}

}  // namespace hyperex::expression
