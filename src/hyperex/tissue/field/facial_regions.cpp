// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/facial_regions.hpp"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "hyperex/tissue/field/data.hpp"

namespace hyperex::tissue {

const std::vector<FacialRegion>& facial_regions() {
  static const std::vector<FacialRegion> regions = [] {
    std::vector<FacialRegion> list;
    std::istringstream lines{std::string(regions_csv())};
    for (std::string line; std::getline(lines, line);) {
      if (line.empty() || line[0] == '#' || line.starts_with("name,")) continue;
      const auto first = line.find(','), second = line.find(',', first + 1);
      // Our own file: a fault in it is a fault of the build.
      if (second == std::string::npos)
        throw std::logic_error("the table of regions inside this program is damaged");
      FacialRegion region{line.substr(0, first), line.substr(first + 1, second - first - 1), {}};
      std::istringstream words(line.substr(second + 1));
      for (int v; words >> v;) region.vertices.push_back(v);
      list.push_back(std::move(region));
    }
    return list;
  }();
  return regions;
}

bool is_region(const std::string& name) {
  return std::ranges::any_of(facial_regions(), [&](const FacialRegion& region) {
    return name == region.name || name == region.name + "_L" || name == region.name + "_R";
  });
}

}  // namespace hyperex::tissue
