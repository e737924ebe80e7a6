// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "hyperex/core/assert.hpp"

namespace hyperex {

/// The quantile at `share` (0 to 1) of rising values, at least one; linear between neighbours.
inline double quantile_of_sorted(const std::vector<double>& sorted, double share) {
  HX_ASSERT(!sorted.empty());
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto low = static_cast<std::size_t>(position);
  const std::size_t high = std::min(low + 1, sorted.size() - 1);
  return sorted[low] + (position - static_cast<double>(low)) * (sorted[high] - sorted[low]);
}

/// The middle one of at least one value; of an even number the upper of the two.
inline double median(std::vector<double> values) {
  HX_ASSERT(!values.empty());
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// The median difference of consecutive values, at least two.
inline double median_step(const std::vector<double>& values) {
  HX_ASSERT(values.size() > 1);
  std::vector<double> steps;
  for (std::size_t k = 1; k < values.size(); ++k) steps.push_back(values[k] - values[k - 1]);
  return median(std::move(steps));
}

}  // namespace hyperex
