// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "hyperex/core/printable.hpp"

namespace hyperex {

namespace {
constexpr std::size_t most_quoted = 120, most_problems = 20, most_in_line = 900;
}

std::string InputProblem::sentence() const {
  std::string where = file.string();
  if (line > 0 && !where.empty()) where += fmt::format(":{}", line);
  std::string what = printable(key, most_quoted);
  if (!value.empty()) what += (key.empty() ? "" : " = ") + printable(value, most_quoted);
  std::string text = where;
  if (!what.empty()) text += (text.empty() ? "" : ": ") + what;
  // A path, and what is expected, may hold names from files too.
  return printable(text + (text.empty() ? "expected " : ": expected ") + expected, most_in_line);
}

namespace {
std::string join(const std::vector<InputProblem>& problems) {
  std::string text;
  for (std::size_t i = 0; i < std::min(problems.size(), most_problems); ++i)
    text += (i == 0 ? "" : "\n") + problems[i].sentence();
  if (problems.size() > most_problems)
    text += fmt::format("\n... and {} problems more", problems.size() - most_problems);
  return text;
}

std::shared_ptr<const std::vector<InputProblem>> kept(std::vector<InputProblem> problems) {
  return std::make_shared<const std::vector<InputProblem>>(std::move(problems));
}
}  // namespace

InputError::InputError(const InputProblem& problem)
    : std::runtime_error(problem.sentence()), problems_(kept({problem})) {}
InputError::InputError(const std::vector<InputProblem>& problems)
    : std::runtime_error(join(problems)), problems_(kept(problems)) {}
InputError::InputError(const std::filesystem::path& file, const std::string& message)
    : std::runtime_error(printable(file.string() + ": " + message)), problems_(kept({})) {}

InputError::InputError(const std::string& sentences)
    : std::runtime_error(sentences), problems_(kept({})) {}

}  // namespace hyperex
