// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "hyperex/io/csv_cells.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::io {
namespace {

/// The value of a cell: read as a number or, if it is none, by `number_of`. Empty if that fails
/// too.
std::optional<double> number_in(const std::string& name, std::string_view cell,
                                const TextReader& number_of) {
  const auto number = parse_number(cell);
  return !number && number_of ? number_of(name, cell) : number;
}

/// Whether a cell is a number with a decimal comma, "0,033", as spreadsheets write it in many
/// languages.
bool has_decimal_comma(const std::string& name, std::string_view cell,
                       const TextReader& number_of) {
  std::string text(cell.substr(0, 40));
  const auto comma = text.find(',');
  if (comma == std::string::npos) return false;
  text[comma] = '.';
  return number_in(name, text, number_of).has_value();
}

double read_cell(const CsvTable& table, int line, std::size_t column, std::string_view cell,
                 const TextReader& number_of) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  cell = trimmed(cell);
  if (cell.empty()) return nan;
  const std::string& name = table.names[column];
  const auto number = number_in(name, cell, number_of);
  if (!number || std::isinf(*number))
    throw InputError({table.file, line, fmt::format("column {} ({})", column + 1, quotable(name)),
                      quotable(cell),
                      has_decimal_comma(name, cell, number_of)
                          ? std::string("a finite number with a point, not a "
                                        "comma, before its decimals (save as "
                                        "CSV in English, or replace , by .)")
                          : "a finite number, nan or nothing"});
  return std::isnan(*number) ? nan : *number;
}

/// `fill` returns the text that follows the numbers of a row.
void write_table(const std::filesystem::path& file, const std::vector<std::string>& names,
                 std::size_t numbers, long rows,
                 const std::function<std::string(long, std::vector<double>&)>& fill) {
  for (const auto& name : names)
    if (name.empty() || name.find_first_of("\r\n") != std::string::npos)
      throw std::invalid_argument("write_csv: a name is empty or holds a line break: " + name);
  write_file_atomically(file, [&](std::ostream& stream) {
    for (std::size_t c = 0; c < names.size(); ++c)
      stream << (c == 0 ? "" : ",") << in_quotes_where_needed(names[c]);
    stream << '\n';
    std::vector<double> values(numbers);
    for (long row = 0; row < rows; ++row) {
      const std::string behind = fill(row, values);
      stream << fmt::format("{}{}\n", fmt::join(values, ","), behind);
    }
  });
}

}  // namespace

std::optional<int> CsvTable::find(const std::string& name) const {
  const auto place = std::find(names.begin(), names.end(), name);
  if (place == names.end()) return std::nullopt;
  return static_cast<int>(place - names.begin());
}

int CsvTable::column(const std::string& name) const {
  if (const auto found = find(name)) return *found;
  throw InputError({file, 0, "", "", fmt::format("a column \"{}\"; there is none", name)});
}

CsvTable read_csv(const std::filesystem::path& file) {
  return read_csv(file, {});
}

CsvTable read_csv(const std::filesystem::path& file, const TextReader& number_of) {
  CsvTable table;
  table.file = file;
  std::vector<double> values;
  walk_table(file, table.names, [&](std::string_view line, int number, char separator) {
    std::vector<std::string> unquoted;
    std::vector<std::string_view> cells;
    if (line.find('"') == std::string_view::npos) {
      cells = split(line, separator);
    } else {
      unquoted = cells_of(line, separator);
      cells.assign(unquoted.begin(), unquoted.end());
    }
    check_length(file, number, cells.size(), table.names.size(), separator);
    for (std::size_t c = 0; c < cells.size(); ++c)
      values.push_back(read_cell(table, number, c, cells[c], number_of));
    table.lines.push_back(number);
  });
  table.values = Eigen::Map<const decltype(table.values)>(
      values.data(), static_cast<Eigen::Index>(table.lines.size()),
      static_cast<Eigen::Index>(table.names.size()));
  return table;
}

void write_csv(const std::filesystem::path& file, const std::vector<std::string>& names, long rows,
               const std::function<void(long, std::vector<double>&)>& fill) {
  write_table(file, names, names.size(), rows, [&](long row, std::vector<double>& values) {
    fill(row, values);
    return std::string();
  });
}

void write_csv_with_text(const std::filesystem::path& file, const std::vector<std::string>& names,
                         const std::string& text_name, long rows,
                         const std::function<std::string(long, std::vector<double>&)>& fill) {
  std::vector<std::string> all = names;
  all.push_back(text_name);
  write_table(file, all, names.size(), rows, [&](long row, std::vector<double>& values) {
    std::string text = fill(row, values);
    for (char& c : text) {
      if (c == ',') c = ';';
      if (c == '"') c = '\'';
      if (c == '\n' || c == '\r') c = ' ';
    }
    return "," + text;
  });
}

void write_csv(const std::filesystem::path& file, const std::vector<std::string>& names,
               const Eigen::Ref<const Eigen::MatrixXd>& rows) {
  if (rows.cols() != static_cast<Eigen::Index>(names.size()))
    throw std::invalid_argument("write_csv: as many columns as names");
  write_csv(file, names, rows.rows(), [&](long row, std::vector<double>& values) {
    for (Eigen::Index c = 0; c < rows.cols(); ++c) values[c] = rows(row, c);
  });
}

}  // namespace hyperex::io
