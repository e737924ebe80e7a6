// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parsers of nested texts, and all that walks what they make, call themselves once a level: how
// deep a text goes is counted before.
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperex::io {

inline constexpr int most_nested = 64;

/// The line (1-based) at which a JSON text opens more than most_nested brackets; 0 where none does.
int line_nested_too_deep_json(std::string_view text);
/// The same of TOML; a key of more than most_nested parts (a.b.c) counts too.
int line_nested_too_deep_toml(std::string_view text);
/// "nested deeper than 64 levels"
std::string too_deep();
/// Throws InputError where the JSON text of `file` is nested too deep.
void check_nesting_json(const std::filesystem::path& file, std::string_view text);
/// The same of a TOML text.
void check_nesting_toml(const std::filesystem::path& file, std::string_view text);

}  // namespace hyperex::io
