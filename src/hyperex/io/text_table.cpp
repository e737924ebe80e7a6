// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/text_table.hpp"

#include "hyperex/core/assert.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/csv_cells.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::io {

TextTable read_text_table(const std::filesystem::path& file) {
  const std::string text = read_file(file);
  TextTable table;
  table.file = file;
  char separator = ',';
  Lines lines(text);
  std::string_view line;
  while (lines.next(line)) {
    if (trimmed(line).empty() || trimmed(line).front() == '#') continue;
    if (table.names.empty()) {
      separator = separator_of(line);
      table.names = read_names(file, lines.number(), line, separator);
      continue;
    }
    std::vector<std::string> cells = cells_of(line, separator);
    check_length(file, lines.number(), cells.size(), table.names.size(), separator);
    table.rows.push_back(std::move(cells));
    table.lines.push_back(lines.number());
  }
  if (table.names.empty())
    throw InputError(file, "is empty; expected a table whose first line names its columns");
  return table;
}

void write_text_table(const std::filesystem::path& file, const std::vector<std::string>& names,
                      const std::vector<std::vector<std::string>>& rows) {
  const auto write_row = [](std::ostream& stream, const std::vector<std::string>& cells) {
    for (std::size_t c = 0; c < cells.size(); ++c) {
      std::string cell = cells[c];
      for (char& letter : cell)
        if (letter == '\n' || letter == '\r') letter = ' ';
      stream << (c == 0 ? "" : ",") << in_quotes_where_needed(cell);
    }
    stream << '\n';
  };
  write_file_atomically(file, [&](std::ostream& stream) {
    write_row(stream, names);
    for (const auto& row : rows) {
      HX_ASSERT(row.size() == names.size());
      write_row(stream, row);
    }
  });
}

}  // namespace hyperex::io
