// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visit_figures.hpp"

#include <fmt/format.h>

namespace hyperex::visits {

std::string figure(double value, int digits) {
  const std::string text = fmt::format("{:.{}f}", value, digits);
  return text.find_first_not_of("-0.") == std::string::npos && text.front() == '-' ? text.substr(1)
                                                                                   : text;
}

std::string signed_figure(double value, int digits) {
  const std::string text = figure(value, digits);
  const bool nothing = text.find_first_not_of("0.") == std::string::npos;
  return nothing || text.front() == '-' ? text : "+" + text;
}

int digits_of(const Change& change) {
  if (change.beyond != Beyond::yes || !change.all) return 1;
  const auto to_nothing = [](double bound) { return bound != 0 && figure(bound) == "0.0"; };
  return to_nothing(change.all->low) || to_nothing(change.all->high) ? 2 : 1;
}

}  // namespace hyperex::visits
