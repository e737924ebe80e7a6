// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/describe.hpp"

#include <fmt/format.h>

#include <charconv>

namespace hyperex {

std::string Bounds::text() const {
  return fmt::format("{}{}{:g} to {:g}", or_zero ? "0, or " : "", above_least ? "above " : "",
                     least, most);
}

std::string Bounds::expected(const std::string& what) const {
  return fmt::format("{} {}{}", what, above_least || or_zero ? "" : "from ", text());
}

double Unit::from_si(double si) const {
  const std::string text = fmt::format("{:.15g}", si * over / times);
  double value = si * over / times;
  std::from_chars(text.data(), text.data() + text.size(), value);
  return value;
}

Bounds Unit::from_si(const Bounds& si) const {
  return {from_si(si.least), from_si(si.most), si.above_least, si.or_zero};
}

std::string key_of(std::string_view member, const OptionDetails& details) {
  if (details.key) return details.key;
  std::string key = python_name(member, details);
  const std::string_view ending = details.unit.si_ending;
  if (key.ends_with(ending))
    key.replace(key.size() - ending.size(), ending.size(), details.unit.ending);
  return key;
}

}  // namespace hyperex
