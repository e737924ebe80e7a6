// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What the readers and writers of tables of numbers (csv.hpp) and of texts (text_table.hpp) share.
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::io {

/// The cells of a line, trimmed; those in quotes may hold separators and doubled quotes (RFC 4180).
std::vector<std::string> cells_of(std::string_view line, char separator);

/// Comma, semicolon or tab: the first of them that parts the line of names.
char separator_of(std::string_view header);

/// `name` as a cell that cells_of() gives back.
std::string in_quotes_where_needed(const std::string& name);

/// The names in the first line. InputError: numbers in their place, one that is empty, not
/// printable or there twice.
std::vector<std::string> read_names(const std::filesystem::path& file, int line,
                                    std::string_view header, char separator);

/// Calls `row` with each line below that of names, its number and the separator; comments and empty
/// lines are left out. `names` are there before the first call. InputError: no names.
void walk_table(const std::filesystem::path& file, std::vector<std::string>& names,
                const std::function<void(std::string_view line, int number, char separator)>& row);

/// InputError where a row has another number of cells than there are names.
void check_length(const std::filesystem::path& file, int line, std::size_t cells, std::size_t names,
                  char separator);

}  // namespace hyperex::io
