// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/expected_error_words.hpp"

#include <fmt/format.h>

namespace hyperex::run {

std::string expected_error_line(const nlohmann::ordered_json& summary) {
  if (!summary.contains("uncertainty")) return "";
  std::string errors, shares;
  for (const char* region : {"lips", "cheeks", "eyes", "forehead"}) {
    const auto at = summary["uncertainty"].find(region);
    if (at == summary["uncertainty"].end()) continue;
    const char* comma = errors.empty() ? "" : ", ";
    errors += fmt::format("{}{} {:.1f} mm", comma, region, (*at)["distance_rms_mm"].get<double>());
    shares += fmt::format("{}{} {:.0f} %", comma, region, 100 * (*at)["determined"].get<double>());
  }
  if (errors.empty()) return "";
  return fmt::format(
      "expected error of the skin between the driven points: {}\n"
      "  how much of its motion (variance) the recording shows: {}; the rest is how faces usually "
      "move\n",
      errors, shares);
}

}  // namespace hyperex::run
