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
/// The line at which a TOML text has a character beyond ASCII outside of strings and comments,
/// where TOML has none; 0 where there is none. toml++ 3.3 takes letters from U+00A1 to U+0499 there
/// for whitespace or not, as undefined behaviour has it.
int line_of_bare_non_ascii_toml(std::string_view text);

/// Where a TOML text must not be parsed, and why not: "nested deeper ..."; line 0 where it may.
struct TomlRefusal {
  int line = 0;
  std::string why;
};
TomlRefusal refusal_of_toml(std::string_view text);

/// "nested deeper than 64 levels"
std::string too_deep();
/// Throws InputError where the JSON text of `file` is nested too deep.
void check_nesting_json(const std::filesystem::path& file, std::string_view text);

}  // namespace hyperex::io
