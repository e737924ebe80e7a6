// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/factor_memory.hpp"

#include <fmt/format.h>

#include "hyperex/core/error.hpp"
#include "hyperex/core/memory.hpp"
#include "hyperex/core/size_text.hpp"

namespace hyperex::fem {

double factor_bytes(const FactorForecast& forecast) {
  return kStoredShare * forecast.entries * sizeof(double) * (1 + kStackShare) +
         kWorkspaceBytes * forecast.matrix_entries;
}

void check_factor_fits(const FactorForecast& forecast, double available_bytes,
                       const std::string& purpose) {
  if (const double stored = kStoredShare * forecast.entries; stored > kMostFactorEntries)
    throw NumericalError(
        fmt::format("{}: the factor of the matrix would have {:.3g} entries, and at most {:.3g} "
                    "are possible; a coarser mesh has fewer",
                    purpose, stored, kMostFactorEntries));
  if (const double bytes = factor_bytes(forecast); bytes > kFactorShare * available_bytes)
    throw NumericalError(
        fmt::format("{}: the factor of the matrix takes {} of memory and {} are available; a "
                    "coarser mesh takes less",
                    purpose, size_text(bytes), size_text(available_bytes)));
}

double available_memory_bytes() {
  return hyperex::available_memory_bytes();
}

}  // namespace hyperex::fem
