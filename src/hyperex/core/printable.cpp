// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyperex {
namespace {
bool within_character(char c) {
  return (static_cast<unsigned char>(c) & 0xC0) == 0x80;
}
}  // namespace

std::string printable(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t in_line = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '\n') {
      out += c;
      in_line = 0;
    } else if (in_line < most || (in_line == most && within_character(c))) {
      if (byte < 0x20 || byte == 0x7f)
        out += fmt::format("\\x{:02x}", byte);
      else
        out += c;
      if (!within_character(c)) ++in_line;
    } else if (in_line == most) {
      out += "...";
      ++in_line;
    }
  }
  return out;
}

std::string first_lines(const std::string& text, std::size_t most) {
  std::size_t lines = 0, end = 0;
  for (std::size_t at = 0; at != std::string::npos && at < text.size(); ++lines) {
    at = text.find('\n', at);
    if (lines + 1 == most) end = std::min(at, text.size());
    if (at != std::string::npos) ++at;
  }
  if (lines <= most) return text;
  return text.substr(0, end) + fmt::format("\n... and {} lines more", lines - most);
}

}  // namespace hyperex
