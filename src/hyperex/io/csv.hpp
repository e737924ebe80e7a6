// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::io {

/// A table of numbers with a name a column.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::string> names;
  /// rows x columns; NaN where a cell is empty or "nan".
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  std::vector<int> lines;  ///< of each row in the file, 1-based, for messages

  /// Where the column of that name is.
  std::optional<int> find(const std::string& name) const;
  /// The same; InputError naming file and column where there is none.
  int column(const std::string& name) const;
};

/// Reads a table whose first line holds the names. Cells are separated by commas (or by semicolons
/// or tabs, where the first line has no comma); blanks around cells, quotes around cells (which
/// then may hold separators, and quotes doubled: RFC 4180, without line breaks in them), a
/// byte-order mark, "\r\n", empty lines and lines beginning with '#' are put up with. No rows at
/// all is a table of none. Throws InputError naming line and column: no names, a name twice or
/// empty, numbers in place of names, a row of another length, a cell that is no finite number.
CsvTable read_csv(const std::filesystem::path& file);
/// The same for a table that has texts too: `number_of` gives the number that a cell of the column
/// `name` stands for where it is none itself, or nothing where it stands for none.
using TextReader =
    std::function<std::optional<double>(const std::string& name, std::string_view cell)>;
CsvTable read_csv(const std::filesystem::path& file, const TextReader& number_of);

/// Writes a row a line, each number in the fewest digits that give it back exactly; NaN as "nan".
/// Names with separators or quotes stand in quotes, as read_csv takes them.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& names,
               const Eigen::Ref<const Eigen::MatrixXd>& rows);

/// The same for rows made one by one: `fill(row, values)` is called for 0 ... rows - 1 in order,
/// `values` as long as `names`.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& names, long rows,
               const std::function<void(long, std::vector<double>&)>& fill);

/// The same with a column `text_name` of texts at the end: `fill` gives a row's. Commas, quotes and
/// line breaks in them become semicolons, apostrophes and blanks, so that every reader gets along.
void write_csv_with_text(const std::filesystem::path& file, const std::vector<std::string>& names,
                         const std::string& text_name, long rows,
                         const std::function<std::string(long, std::vector<double>&)>& fill);

}  // namespace hyperex::io
