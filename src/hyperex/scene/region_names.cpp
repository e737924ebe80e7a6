// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/region_names.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/core/lower_case.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/tissue/field/facial_regions.hpp"

namespace hyperex::scene {

SidedName sided(std::string name) {
  for (const auto& [word, side] :
       {std::pair<std::string, std::string>{"right", "_R"}, {"left", "_L"}}) {
    if (lower_case(name).starts_with(word + "_")) return {name.substr(word.size() + 1), side};
    if (lower_case(name).ends_with("_" + word))
      return {name.substr(0, name.size() - word.size() - 1), side};
    if (lower_case(name).ends_with(lower_case(side)))
      return {name.substr(0, name.size() - 2), side};
  }
  return {name, ""};
}

std::string nearest_part(const std::string& part, const std::vector<std::string>& parts) {
  const bool known = std::find(parts.begin(), parts.end(), part) != parts.end();
  return known ? part : nearest(part, parts);
}

std::string nearest_region(std::string name) {
  std::erase(name, '"');
  if (tissue::is_region(name)) return "";
  SidedName given = sided(name);
  for (const char* whole : {"side", "half", "head"})
    if (lower_case(given.part) == whole) given.part = "face";
  std::vector<std::string> parts;
  for (const auto& region : tissue::facial_regions()) parts.push_back(region.name);
  const std::string near = nearest_part(given.part, parts);
  return near.empty() ? "" : near + given.side;
}

std::string did_you_mean_region(const std::string& key, const std::string& name) {
  const bool of_region = key.find("region[") != std::string::npos && key.ends_with("].name");
  const std::string near = of_region ? nearest_region(name) : "";
  return near.empty() ? "" : "; did you mean " + near + "?";
}

}  // namespace hyperex::scene
