// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace hyperex {

/// `text` made safe for a terminal: control characters except line breaks are written as "\x1b",
/// and each line is cut after `most` characters, never within a UTF-8 sequence.
std::string printable(std::string_view text, std::size_t most = 600);

/// The first `most` lines, and a last one that says how many more there are.
std::string first_lines(const std::string& text, std::size_t most = 20);

}  // namespace hyperex
