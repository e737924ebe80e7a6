// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/known_activation.hpp"

#include <cmath>

#include "hyperex/core/within_95.hpp"

namespace hyperex::simulate {

bool differs_from_zero(double activation, double sigma) {
  return std::abs(activation) > kWithin95 * sigma;
}

}  // namespace hyperex::simulate
