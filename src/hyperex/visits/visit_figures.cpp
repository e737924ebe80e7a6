// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/visit_figures.hpp"

#include <fmt/format.h>

namespace hyperex::visits {

std::string figure(double value) {
  const std::string text = fmt::format("{:.1f}", value);
  return text == "-0.0" ? "0.0" : text;
}

std::string signed_figure(double value) {
  const std::string text = figure(value);
  return text == "0.0" || text.starts_with('-') ? text : "+" + text;
}

}  // namespace hyperex::visits
