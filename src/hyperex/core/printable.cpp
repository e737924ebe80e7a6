// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/printable.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace hyperex {
namespace {

/// Bytes of the character that `text` begins with; 0 where it is no UTF-8 (RFC 3629).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned char first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
  if (length == 0 || first > 0xF4 || text.size() < length) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xC0) != 0x80) return 0;
  const bool sound = !(first == 0xE0 && byte(1) < 0xA0) && !(first == 0xED && byte(1) > 0x9F) &&
                     !(first == 0xF0 && byte(1) < 0x90) && !(first == 0xF4 && byte(1) > 0x8F);
  return sound ? length : 0;
}

/// C0, DEL and C1 (U+0080 to U+009F), which some terminals obey too.
bool is_control(std::string_view character) {
  const auto first = static_cast<unsigned char>(character[0]);
  return first < 0x20 || first == 0x7f ||
         (first == 0xC2 && static_cast<unsigned char>(character[1]) < 0xA0);
}

}  // namespace

bool is_utf8(std::string_view text) {
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) return false;
    text.remove_prefix(length);
  }
  return true;
}

std::string printable(std::string_view text, std::size_t most) {
  std::string out;
  std::size_t in_line = 0;
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    const std::string_view character = text.substr(0, std::max<std::size_t>(length, 1));
    text.remove_prefix(character.size());
    if (character == "\n") {
      out += '\n';
      in_line = 0;
    } else if (in_line < most) {
      if (length == 0 || is_control(character))
        for (const char c : character)
          out += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
      else
        out += character;
      ++in_line;
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
