// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Functions shared by the tables of numbers (csv.hpp) and of text (text_table.hpp).
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::io {

/// The cells of a line, trimmed. Quoted cells may contain separators and doubled quotes (RFC 4180).
std::vector<std::string> cells_of(std::string_view line, char separator);

/// The separator of a table: the first of comma, semicolon and tab that occurs in the line of
/// names.
char separator_of(std::string_view header);

/// `name` as a cell, quoted if necessary, so that cells_of() returns it unchanged.
std::string in_quotes_where_needed(const std::string& name);

/// The names in the first line. Throws InputError if there are numbers instead, or if a name is
/// empty, not printable or occurs twice.
std::vector<std::string> read_names(const std::filesystem::path& file, int line,
                                    std::string_view header, char separator);

/// Calls `row` for each line below the line of names, with its number and the separator. Comments
/// and empty lines are skipped. `names` is filled before the first call. Throws InputError if there
/// are no names, or the file is no text (refuse_other_than_text).
void walk_table(const std::filesystem::path& file, std::vector<std::string>& names,
                const std::function<void(std::string_view line, int number, char separator)>& row);

/// Throws InputError if the number of cells differs from the number of names.
void check_length(const std::filesystem::path& file, int line, std::size_t cells, std::size_t names,
                  char separator);

}  // namespace hyperex::io
