// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The bounds that a struct of options describes (core/describe.hpp).
#include <fmt/format.h>

#include <cmath>
#include <string>
#include <vector>

#include "hyperex/core/describe.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex {

/// Collects the options that are out of their bounds, by the names of their members.
template <class Options>
class BoundsCheck {
 public:
  BoundsCheck(const Options& options, std::string prefix, std::vector<InputProblem>& problems)
      : options_(options), prefix_(std::move(prefix)), problems_(problems) {}

  template <class At>
  void option(const char* name, At at, const char*, const OptionDetails& details = {}) {
    check(prefix_ + name, at(options_), details);
  }
  template <class At, class AllAt>
  void one_or_all(const char*, At, const char*, AllAt, const char*) {}
  template <class At, class Words>
  void factors(const char* name, At at, const Words&, const char*, const OptionDetails& details) {
    option(name, at, "", details);
  }

 private:
  void check(const std::string& name, double value, const OptionDetails& details) {
    check_number(name, value, "a number", details.bounds);
  }
  void check(const std::string& name, int value, const OptionDetails& details) {
    check_number(name, value, "an integer", details.bounds);
  }
  void check(const std::string& name, const std::optional<double>& value,
             const OptionDetails& details) {
    if (value) check(name, *value, details);
  }
  template <class Value>
  void check(const std::string& name, const std::vector<Value>& values,
             const OptionDetails& details) {
    // A list that may be left out is empty; one of a fixed length is not.
    const std::size_t n = values.size();
    const bool left_out = n == 0 && details.least < details.most;
    if (n > details.most || (n < details.least && !left_out))
      problems_.push_back({{}, 0, name, fmt::format("{} of them", n), number_of(details)});
    for (std::size_t i = 0; i < values.size(); ++i)
      check(fmt::format("{}[{}]", name, i), values[i], details);
  }
  template <class Value>
  void check(const std::string& name, const Value& value, const OptionDetails&) {
    if constexpr (Described<Value>) {
      BoundsCheck<Value> inner(value, name + ".", problems_);
      Value::describe(inner);
    }
  }
  static std::string number_of(const OptionDetails& details) {
    if (details.least == details.most) return fmt::format("{}", details.most);
    return fmt::format("{} to {}", details.least, details.most);
  }
  void check_number(const std::string& name, double value, const char* what, const Bounds& bounds) {
    if (!std::isfinite(value) || !bounds.holds(value))
      problems_.push_back({{}, 0, name, fmt::format("{:g}", value), bounds.expected(what)});
  }

  const Options& options_;
  std::string prefix_;
  std::vector<InputProblem>& problems_;
};

/// Each option that is out of its bounds, with its value and the bounds.
template <Described Options>
std::vector<InputProblem> out_of_bounds(const Options& options) {
  std::vector<InputProblem> problems;
  BoundsCheck<Options> check(options, "", problems);
  Options::describe(check);
  return problems;
}

}  // namespace hyperex
