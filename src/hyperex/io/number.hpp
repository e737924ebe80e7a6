// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Words and numbers in text files, independent of the locale.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::io {

/// The number that the whole of `text` represents. "nan" and "inf" are numbers.
std::optional<double> parse_number(std::string_view text);
/// A whole number, such as a count; nothing for "1.5" or a value out of range.
std::optional<long long> parse_integer(std::string_view text);

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// The parts between separators, untrimmed: "a,,b" has three parts, "" has one.
std::vector<std::string_view> split(std::string_view line, char separator);
/// The parts between runs of blanks and tabs; none is empty.
std::vector<std::string_view> words(std::string_view line);

/// Reads a text line by line with any kind of line ending; skips a byte-order mark.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// Moves to the next line; returns false after the last. `line` does not contain the line ending.
  bool next(std::string_view& line);
  int number() const { return number_; }  ///< 1-based number of the last line returned

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// Whether `text` can be used as a name. It must be UTF-8, because reports are, and without control
/// characters, which would affect the terminal.
bool is_printable_name(std::string_view text);
/// The corresponding expectation in error messages.
inline constexpr const char* printable_name = "a name in UTF-8 without control characters";

/// At most 40 characters of `text`, suitable for quoting in a one-line error message.
std::string quotable(std::string_view text);

}  // namespace hyperex::io
