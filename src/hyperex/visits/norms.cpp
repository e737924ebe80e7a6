// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/norms.hpp"

#include <algorithm>

namespace hyperex::visits {

const std::vector<Norm>& norms() {
  constexpr const char* kJorge = "Jorge et al., Braz. J. Otorhinolaryngol. 78, 2012, 41";
  static const std::vector<Norm> all = {
      {Expression::Movement::corners, "corner of the mouth", 9.28, 2.83, 12, kJorge},
      {Expression::Movement::brows, "brow", 10.57, 2.51, 12, kJorge}};
  return all;
}

const Norm* norm_of(const Expression& expression) {
  // Showing the teeth and puckering are judged by the corners too, but are no smiles.
  if (expression.movement == Expression::Movement::corners && expression.name != "smile")
    return nullptr;
  const auto found = std::ranges::find(norms(), expression.movement, &Norm::movement);
  return found == norms().end() ? nullptr : &*found;
}

}  // namespace hyperex::visits
