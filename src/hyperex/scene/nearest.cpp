// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>

#include "hyperex/core/lower_case.hpp"
#include "hyperex/core/slips.hpp"
#include "hyperex/scene/keys.hpp"

namespace hyperex::scene {
namespace {

std::string last_of_key(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

}  // namespace

std::string section_of(const std::string& key) {
  const auto dot = key.find('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

std::string nearest(const std::string& name, const std::vector<std::string>& candidates) {
  const std::string given = lower_case(name).substr(0, 100), given_last = last_of_key(given);
  const std::string given_section = section_of(given);
  // Among equally near keys, the one with the nearest section is chosen.
  const auto off_section = [&](const std::string& candidate) {
    return given_section.empty() ? 0 : slips(given_section, section_of(lower_case(candidate)));
  };
  std::string best;
  std::size_t best_slips = std::max<std::size_t>(1, given_last.size() / 3) + 1;
  for (const auto& candidate : candidates) {
    const std::string last = last_of_key(candidate);
    // The same last part in another section, or without its unit, counts as at most one typing
    // error.
    std::size_t far =
        std::min(slips(given, lower_case(candidate)), slips(given_last, lower_case(last)) + 1);
    if (!given_last.empty() && last.rfind(given_last + "_", 0) == 0)
      far = std::min<std::size_t>(far, section_of(given) == section_of(candidate) ? 0 : 1);
    if (far > best_slips) continue;
    if (far == best_slips && (best.empty() || off_section(candidate) >= off_section(best)))
      continue;
    best_slips = far;
    best = candidate;
  }
  return best;
}

}  // namespace hyperex::scene
