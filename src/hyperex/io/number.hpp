// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Words and numbers in text files, read the same way under every locale.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hyperex::io {

/// The number that `text` holds from its first to its last character; "nan" and "inf" are numbers.
std::optional<double> parse_number(std::string_view text);
/// A whole number, e.g. a count; nothing for "1.5" or what does not fit.
std::optional<long long> parse_integer(std::string_view text);

/// Without blanks, tabs and carriage returns at both ends.
std::string_view trimmed(std::string_view text);
/// The parts between separators, untrimmed; "a,,b" has three, "" one.
std::vector<std::string_view> split(std::string_view line, char separator);
/// The parts between runs of blanks and tabs; none is empty.
std::vector<std::string_view> words(std::string_view line);

/// Walks through the lines of a text, whatever its line ends are; skips a byte-order mark.
class Lines {
 public:
  explicit Lines(std::string_view text);
  /// Moves to the next line; false behind the last one. Line ends are not part of `line`.
  bool next(std::string_view& line);
  int number() const { return number_; }  ///< 1-based, of the line given last

 private:
  std::string_view rest_;
  int number_ = 0;
};

/// Whether `text` can be a name: UTF-8, which reports are written in, without control characters,
/// which would act on the terminal.
bool is_printable_name(std::string_view text);
/// What is expected where it is not.
inline constexpr const char* printable_name = "a name in UTF-8 without control characters";

/// At most 40 characters of `text`, fit to be quoted in one line of an error.
std::string quotable(std::string_view text);

}  // namespace hyperex::io
