// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::io {

/// A table of texts with a name a column.
struct TextTable {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `names`
  std::vector<int> lines;                      ///< of each row in the file, 1-based, for messages
};

/// Reads a CSV as read_csv() does, but leaves its cells as they are. Throws InputError for no
/// names, a name twice or empty, a row of another length.
TextTable read_text_table(const std::filesystem::path& file);

/// Cells in quotes where they need them; line breaks in them become blanks.
void write_text_table(const std::filesystem::path& file, const std::vector<std::string>& names,
                      const std::vector<std::vector<std::string>>& rows);

}  // namespace hyperex::io
