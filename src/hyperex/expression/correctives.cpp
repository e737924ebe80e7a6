// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/correctives.hpp"

#include "hyperex/expression/arkit_names.hpp"

namespace hyperex::expression {

std::string corrective_name(const ShapePair& pair) {
  return pair.first + "_" + pair.second;
}

std::optional<ShapePair> corrected_pair(const std::string& name) {
  for (std::size_t at = name.find('_'); at != std::string::npos; at = name.find('_', at + 1)) {
    const ShapePair pair{arkit_name_of(name.substr(0, at)), arkit_name_of(name.substr(at + 1))};
    if (!pair.first.empty() && !pair.second.empty() && pair.first != pair.second) return pair;
  }
  return std::nullopt;
}

}  // namespace hyperex::expression
