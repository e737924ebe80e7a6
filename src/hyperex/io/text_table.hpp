// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace hyperex::io {

/// A table of text with named columns.
struct TextTable {
  std::filesystem::path file;
  std::vector<std::string> names;
  std::vector<std::vector<std::string>> rows;  ///< each as long as `names`
  std::vector<int> lines;  ///< line number of each row in the file, 1-based, for messages
};

/// Reads a CSV as read_csv() does, but does not interpret its cells. Throws InputError if there are
/// no names, if a name is empty or occurs twice, or if a row has another length.
TextTable read_text_table(const std::filesystem::path& file);

/// Cells are quoted where necessary; line breaks in them are replaced by blanks.
void write_text_table(const std::filesystem::path& file, const std::vector<std::string>& names,
                      const std::vector<std::vector<std::string>>& rows);

}  // namespace hyperex::io
