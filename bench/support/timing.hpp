// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <chrono>
#include <vector>

namespace hyperex::bench {

class Stopwatch {
 public:
  /// Seconds since the last lap.
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double s = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    return s;
  }

 private:
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

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
