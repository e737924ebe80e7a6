// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/error.hpp"

#include <fmt/format.h>

namespace hyperex {

std::string InputProblem::sentence() const {
  std::string where = file.string();
  if (line > 0) where += fmt::format(":{}", line);
  std::string what = key;
  if (!value.empty()) what += (key.empty() ? "" : " = ") + value;
  std::string text = where;
  if (!what.empty()) text += (text.empty() ? "" : ": ") + what;
  return text + (text.empty() ? "expected " : ": expected ") + expected;
}

namespace {
std::string join(const std::vector<InputProblem>& problems) {
  std::string text;
  for (const auto& problem : problems) {
    if (!text.empty()) text += '\n';
    text += problem.sentence();
  }
  return text;
}
}  // namespace

InputError::InputError(const InputProblem& problem) : std::runtime_error(problem.sentence()) {}
InputError::InputError(const std::vector<InputProblem>& problems)
    : std::runtime_error(join(problems)) {}
InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : std::runtime_error(file.string() + ": " + message) {}

InputError::InputError(const std::string& sentences) : std::runtime_error(sentences) {}

}  // namespace hyperex
