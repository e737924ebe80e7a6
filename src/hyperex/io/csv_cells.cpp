// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/csv_cells.hpp"

#include <fmt/format.h>

#include <set>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/number.hpp"
#include "hyperex/io/text_file.hpp"

namespace hyperex::io {

std::vector<std::string> cells_of(std::string_view line, char separator) {
  std::vector<std::string> cells;
  while (true) {
    const auto begin = line.find_first_not_of(separator == '\t' ? " \r" : " \t\r");
    std::string cell;
    std::size_t end = 0;
    if (begin != std::string_view::npos && line[begin] == '"') {
      std::size_t at = begin + 1;
      for (; at < line.size(); ++at) {
        if (line[at] == '"' && (at + 1 == line.size() || line[at + 1] != '"')) break;
        if (line[at] == '"') ++at;
        cell += line[at];
      }
      end = at < line.size() ? at + 1 : std::string_view::npos;
    }
    if (end == 0 || end == std::string_view::npos) {  // not quoted, or the quote is not closed
      cell.clear();
      end = 0;
    }
    const auto next = line.find(separator, end);
    cell += line.substr(end, next == std::string_view::npos ? next : next - end);
    cells.emplace_back(trimmed(cell));
    if (next == std::string_view::npos) return cells;
    line.remove_prefix(next + 1);
  }
}

char separator_of(std::string_view header) {
  for (const char separator : {',', ';', '\t'})
    if (cells_of(header, separator).size() > 1) return separator;
  return ',';
}

std::string in_quotes_where_needed(const std::string& name) {
  if (name.find_first_of(",;\"\r\n") == std::string::npos) return name;
  std::string quoted = "\"";
  for (const char c : name) quoted += c == '"' ? "\"\"" : std::string(1, c);
  return quoted + '"';
}

std::vector<std::string> read_names(const std::filesystem::path& file, int line,
                                    std::string_view header, char separator) {
  std::vector<std::string> names;
  std::set<std::string> known;
  bool all_numbers = true;
  for (std::string& cell : cells_of(header, separator)) {
    all_numbers = all_numbers && parse_number(cell);
    names.push_back(std::move(cell));
  }
  if (all_numbers)
    throw InputError({file, line, "", quotable(header), "the names of the columns, not numbers"});
  for (std::size_t c = 0; c < names.size(); ++c) {
    if (names[c].empty())
      throw InputError({file, line, fmt::format("column {}", c + 1), "", "a name; it is empty"});
    if (!is_printable_name(names[c]))
      throw InputError(
          {file, line, fmt::format("column {}", c + 1), quotable(names[c]), printable_name});
    if (!known.insert(names[c]).second)
      throw InputError({file, line, fmt::format("column {}", c + 1), quotable(names[c]),
                        "each name once; it occurs twice"});
  }
  return names;
}

void check_length(const std::filesystem::path& file, int line, std::size_t cells, std::size_t names,
                  char separator) {
  if (cells == names) return;
  const bool commas = separator == ',' && cells > names && cells <= 2 * names;
  throw InputError(
      {file, line, "", fmt::format("{} cells", cells),
       fmt::format("{}, as the first line names them{}", names,
                   commas ? "; are its decimals behind commas? Then cells must be separated by "
                            "semicolons, and decimals by points"
                          : "")});
}

void walk_table(const std::filesystem::path& file, std::vector<std::string>& names,
                const std::function<void(std::string_view line, int number, char separator)>& row) {
  const std::string text = read_file(file);
  refuse_other_than_text(file, text);
  char separator = ',';
  Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    if (!names.empty()) {
      row(line, lines.number(), separator);
      continue;
    }
    separator = separator_of(line);
    names = read_names(file, lines.number(), line, separator);
  }
  if (names.empty())
    throw InputError(file, "is empty; expected a table whose first line names its columns");
}

}  // namespace hyperex::io
