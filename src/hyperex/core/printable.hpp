// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace hyperex {

/// `text` made safe for a terminal: control characters except line breaks, and bytes that are no
/// UTF-8, are written as "\x1b". Each line is cut after `most` characters, never within a UTF-8
/// sequence.
std::string printable(std::string_view text, std::size_t most = 600);

bool is_utf8(std::string_view text);

/// The first `most` lines, and a last one that says how many more there are.
std::string first_lines(const std::string& text, std::size_t most = 20);

}  // namespace hyperex
