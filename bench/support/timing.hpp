// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/core/quantile.hpp"
#include "hyperex/core/stopwatch.hpp"

namespace hyperex::bench {

template <class Work>
double seconds_of(Work work) {
  Stopwatch watch;
  work();
  return watch.lap();
}

/// The median time of several runs, after one run that is not counted.
template <class Work>
double median_seconds(int repeats, Work work) {
  work();
  std::vector<double> s;
  for (int i = 0; i < repeats; ++i) s.push_back(seconds_of(work));
  return median(s);
}

}  // namespace hyperex::bench
