// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Parsers of nested text, and functions that traverse the results, call themselves once per level.
// To limit the depth of recursion, the nesting of a text is checked before it is parsed.
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperex::io {

inline constexpr int most_nested = 64;

/// The 1-based line at which a JSON text exceeds most_nested nested brackets; 0 if it does not.
int line_nested_too_deep_json(std::string_view text);
/// The same for TOML; a key with more than most_nested parts (a.b.c) counts too.
int line_nested_too_deep_toml(std::string_view text);
/// "nested deeper than 64 levels"
std::string too_deep();
/// Throws InputError if the JSON text of `file` is nested too deeply.
void check_nesting_json(const std::filesystem::path& file, std::string_view text);
/// The same for a TOML text.
void check_nesting_toml(const std::filesystem::path& file, std::string_view text);

}  // namespace hyperex::io
