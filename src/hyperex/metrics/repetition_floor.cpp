// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/repetition_floor.hpp"

namespace hyperex::metrics {

void add_repetition_floor(Excursions& excursions, double repetition_mm) {
  for (PairExcursion& pair : excursions.pairs) {
    pair.repetition_floor_mm = repetition_mm;
    pair.judge();
  }
}

}  // namespace hyperex::metrics
