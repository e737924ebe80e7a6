// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/io/nesting.hpp"

#include <fmt/format.h>

#include "hyperex/core/error.hpp"

namespace hyperex::io {
namespace {

class Scanner {
 public:
  explicit Scanner(std::string_view text) : text_(text) {}

  int json() {
    while (at_ < text_.size()) {
      if (text_[at_] == '"')
        skip_string('"', true);
      else if (bracket_too_deep())
        return line_;
      else
        step();
    }
    return 0;
  }

  int toml() {
    while (next_toml())
      if (too_deep_) return line_;
    return 0;
  }

 private:
  void step() {
    if (text_[at_] == '\n') ++line_;
    ++at_;
  }

  /// Moves past a comment, a string or a character; returns false at the end.
  bool next_toml() {
    if (at_ >= text_.size()) return false;
    const char c = text_[at_];
    if (c == '#') {
      while (at_ < text_.size() && text_[at_] != '\n') step();
      return true;
    }
    if (c == '"' || c == '\'') {
      skip_toml_string(c);
      return true;
    }
    // A dotted key ends at any character that can separate two keys.
    if (c == '.')
      ++dots_;
    else if (std::string_view(",=[]{}\r\n").find(c) != std::string_view::npos)
      dots_ = 0;
    too_deep_ = bracket_too_deep() || dots_ >= most_nested;
    if (!too_deep_) step();
    return true;
  }

  bool bracket_too_deep() {
    const char c = text_[at_];
    if (c == '[' || c == '{') return ++depth_ > most_nested;
    if ((c == ']' || c == '}') && depth_ > 0) --depth_;
    return false;
  }

  /// Moves from the opening quote past the closing one, or to the end of the text.
  void skip_string(char quote, bool escapes) {
    for (step(); at_ < text_.size() && text_[at_] != quote; step())
      if (escapes && text_[at_] == '\\' && at_ + 1 < text_.size()) step();
    if (at_ < text_.size()) step();
  }

  void skip_toml_string(char quote) {
    const std::string triple(3, quote);
    if (!text_.substr(at_).starts_with(triple)) {
      // An unclosed string ends with its line, so that the following lines are checked, too.
      for (step(); at_ < text_.size() && text_[at_] != quote && text_[at_] != '\n'; step())
        if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size()) step();
      if (at_ < text_.size()) step();
      return;
    }
    for (int k = 0; k < 3; ++k) step();
    while (at_ < text_.size() && !text_.substr(at_).starts_with(triple)) {
      if (quote == '"' && text_[at_] == '\\' && at_ + 1 < text_.size()) step();
      step();
    }
    for (int k = 0; k < 3 && at_ < text_.size(); ++k) step();
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1, depth_ = 0, dots_ = 0;
  bool too_deep_ = false;
};

}  // namespace

int line_nested_too_deep_json(std::string_view text) {
  return Scanner(text).json();
}

int line_nested_too_deep_toml(std::string_view text) {
  return Scanner(text).toml();
}

std::string too_deep() {
  return fmt::format("nested deeper than {} levels", most_nested);
}

namespace {
void refuse_if_any(int line, const std::filesystem::path& file) {
  if (line > 0) throw InputError(file, fmt::format("line {} is {}", line, too_deep()));
}
}  // namespace

void check_nesting_json(const std::filesystem::path& file, std::string_view text) {
  refuse_if_any(line_nested_too_deep_json(text), file);
}

void check_nesting_toml(const std::filesystem::path& file, std::string_view text) {
  refuse_if_any(line_nested_too_deep_toml(text), file);
}

}  // namespace hyperex::io
