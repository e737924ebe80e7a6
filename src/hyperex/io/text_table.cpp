// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/text_table.hpp"

#include "hyperex/core/assert.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/csv_cells.hpp"

namespace hyperex::io {

TextTable read_text_table(const std::filesystem::path& file) {
  TextTable table;
  table.file = file;
  walk_table(file, table.names, [&](std::string_view line, int number, char separator) {
    std::vector<std::string> cells = cells_of(line, separator);
    check_length(file, number, cells.size(), table.names.size(), separator);
    table.rows.push_back(std::move(cells));
    table.lines.push_back(number);
  });
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
