// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Options of the command line for members that a struct describes (core/describe.hpp).
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>
#include <type_traits>

#include "hyperex/core/describe.hpp"
#include "hyperex/io/number.hpp"

namespace hyperex::cli {

/// Finds the description of one member.
template <class Options>
struct MemberDescription {
  const Options& options;
  const void* member;
  const char* sentence = nullptr;
  OptionDetails details = {};

  template <class At>
  void option(const char*, At at, const char* about, const OptionDetails& given = {}) {
    if (static_cast<const void*>(&at(options)) != member) return;
    sentence = about;
    details = given;
  }
  template <class At, class AllAt>
  void one_or_all(const char*, At, const char*, AllAt, const char*) {}
  template <class At, class Words>
  void factors(const char*, At, const Words&, const char*, const OptionDetails&) {}
};

/// Adds `flag` for a number among `options`: sentence, unit, bounds and default are those that its
/// struct describes. `options` must live as long as the command.
template <Described Options, class Number>
void add_described(CLI::App& command, const std::string& flag, Options& options,
                   Number Options::*member) {
  MemberDescription<Options> found{options, &(options.*member)};
  Options::describe(found);
  const Unit unit = found.details.unit;
  const Bounds bounds = unit.from_si(found.details.bounds);
  const char* what = std::is_integral_v<Number> ? "an integer" : "a number";
  command
      .add_option_function<Number>(
          flag,
          [&options, member, unit](const Number& value) {
            options.*member = static_cast<Number>(unit.to_si(double(value)));
          },
          found.sentence + (*unit.name ? fmt::format(" ({})", unit.name) : ""))
      ->default_str(fmt::format("{:g}", unit.from_si(double(options.*member))))
      ->check([=](const std::string& text) -> std::string {
        const auto value = io::parse_number(text);
        if (value && std::isfinite(*value) && bounds.holds(*value)) return "";
        return text + ": expected " + bounds.expected(what);
      });
}

}  // namespace hyperex::cli
