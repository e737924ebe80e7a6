// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <string_view>

namespace hyperex {

/// `text` as it may go to a terminal, whatever names from files it holds: control characters but
/// line breaks as "\x1b", each line cut after `most` characters, not within one of UTF-8's.
std::string printable(std::string_view text, std::size_t most = 600);

/// The first `most` lines, and a last one that says how many more there are.
std::string first_lines(const std::string& text, std::size_t most = 20);

}  // namespace hyperex
