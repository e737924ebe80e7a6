// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Three tiers of error. A bug of ours: HX_ASSERT. A mistake in the input: InputError, one sentence
// naming file, key, value and what was expected. Numerical trouble: NumericalError, or better a
// returned report.
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace hyperex {

/// Where in the input something is wrong, and what was expected there.
struct InputProblem {
  std::filesystem::path file;
  int line = 0;  ///< 1-based, 0 where a line means nothing
  std::string key;
  std::string value;
  std::string expected;  ///< e.g. "a number above 0 (s)"

  /// "scene.toml:12: time.step_s = -1: expected a number above 0 (s)"
  std::string sentence() const;
};

/// The user's input cannot be used. what() has one line per problem, at most 20.
class InputError : public std::runtime_error {
 public:
  explicit InputError(const InputProblem& problem);
  explicit InputError(const std::vector<InputProblem>& problems);
  InputError(const std::filesystem::path& file, const std::string& message);
  /// Complete sentences, one per line.
  explicit InputError(const std::string& sentences);

  /// The problems listed by what(). Empty if the error was constructed from sentences.
  const std::vector<InputProblem>& problems() const { return *problems_; }

 private:
  std::shared_ptr<const std::vector<InputProblem>> problems_;
};

/// The input was sound, but a computation failed (no positive pivot, no convergence).
class NumericalError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace hyperex
