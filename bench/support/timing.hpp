// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <vector>

#include "hyperex/core/stopwatch.hpp"

namespace hyperex::bench {

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

template <class Work>
double seconds_of(Work work) {
  Stopwatch watch;
  work();
  return watch.lap();
}

/// The median of several runs, after one that does not count.
template <class Work>
double median_seconds(int repeats, Work work) {
  work();
  std::vector<double> s;
  for (int i = 0; i < repeats; ++i) s.push_back(seconds_of(work));
  return median(s);
}

}  // namespace hyperex::bench
