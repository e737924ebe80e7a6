// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace hyperex::io {

/// A table of numbers with named columns.
struct CsvTable {
  std::filesystem::path file;
  std::vector<std::string> names;
  /// rows x columns; NaN where a cell is empty or "nan".
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> values;
  std::vector<int> lines;  ///< line number of each row in the file, 1-based, for messages

  /// Index of the column with that name.
  std::optional<int> find(const std::string& name) const;
  /// The same; throws InputError naming file and column if there is none.
  int column(const std::string& name) const;
};

/// Reads a table whose first line contains the names. Cells are separated by commas, or by
/// semicolons or tabs if the first line contains no comma. Accepted are: blanks around cells;
/// quoted cells, which may contain separators and doubled quotes (RFC 4180, without line breaks); a
/// byte-order mark; "\r\n"; empty lines; and lines beginning with '#'. A table without rows is
/// valid. Throws InputError naming line and column if there are no names, if a name is empty or
/// occurs twice, if there are numbers in place of names, if a row has another length, or if a cell
/// is not a finite number.
CsvTable read_csv(const std::filesystem::path& file);
/// The same for a table that also contains text. `number_of` is called with the name of the column
/// and the text of each cell that is not a number. It returns the number that the text means, such
/// as the frames of a timecode, or nothing if the text is invalid.
using TextReader =
    std::function<std::optional<double>(const std::string& name, std::string_view cell)>;
CsvTable read_csv(const std::filesystem::path& file, const TextReader& number_of);

/// Writes one line per row. Each number has the fewest digits that reproduce it exactly; NaN is
/// written as "nan". Names with separators or quotes are quoted, as read_csv() expects.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& names,
               const Eigen::Ref<const Eigen::MatrixXd>& rows);

/// The same for rows that are generated one by one. `fill(row, values)` is called for 0 ... rows -
/// 1 in order; `values` is as long as `names`.
void write_csv(const std::filesystem::path& file, const std::vector<std::string>& names, long rows,
               const std::function<void(long, std::vector<double>&)>& fill);

/// The same with a text column `text_name` at the end; `fill` returns the text of a row. In texts,
/// commas, quotes and line breaks are replaced by semicolons, apostrophes and blanks, so that every
/// CSV reader can read them.
void write_csv_with_text(const std::filesystem::path& file, const std::vector<std::string>& names,
                         const std::string& text_name, long rows,
                         const std::function<std::string(long, std::vector<double>&)>& fill);

}  // namespace hyperex::io
