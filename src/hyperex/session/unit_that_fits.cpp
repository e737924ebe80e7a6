// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/unit_that_fits.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <utility>

#include "hyperex/io/scan.hpp"

namespace hyperex::session {

std::optional<std::string> unit_that_fits(double ratio, const std::string& unit_note,
                                          double sizes_differ, const std::string& correct) {
  constexpr std::pair<std::string_view, double> units[] = {
      {"mm", 1e-3}, {"cm", 1e-2}, {"m", 1}, {"inches", 0.0254}};
  const auto read = io::length_unit(unit_note.substr(0, unit_note.find(' ')));
  if (!read) return std::nullopt;
  for (const auto& [name, metres] : units) {
    if (metres == io::metres_per(*read)) continue;
    const double factor = ratio * metres / io::metres_per(*read);
    if (std::abs(std::log(factor)) < std::log(sizes_differ))
      return fmt::format("its lengths are as if in {}, and were read as {}: {}", name, unit_note,
                         name == "inches" ? "give them in mm, cm or m" : correct);
  }
  return std::nullopt;
}

}  // namespace hyperex::session
