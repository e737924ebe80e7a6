// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/held_readings.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hyperex/core/quantile.hpp"
#include "hyperex/motion/point_steps.hpp"
#include "hyperex/motion/stays.hpp"

namespace hyperex::motion {
namespace {

constexpr double kClearly_m = 1e-3;    // farther than jitter and the skin's own small movements
constexpr double kSmallestSteps = 5;   // rounded readings repeat while a point moves slowly
constexpr int kMovingBeside = 3;       // of the four points beside it
constexpr double kRareRepeats = 0.01;  // of all steps; noise repeats no reading
constexpr double kBeyondStepsBeside = 3;

/// Equal readings of the point in row p.
struct Run {
  Eigen::Index p = 0;
  std::size_t first = 0, last = 0;
};

/// The smallest change of a coordinate from one reading to the next, m; infinite where none
/// changes. Of rounded readings it is their last digit.
double smallest_step_m(const std::vector<Points>& at) {
  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k + 1 < at.size(); ++k)
    for (Eigen::Index p = 0; p < at[k].rows(); ++p)
      for (int axis = 0; axis < 3; ++axis)
        if (const double step_m = std::abs(at[k + 1](p, axis) - at[k](p, axis)); step_m > 0)
          least_m = std::min(least_m, step_m);
  return least_m;
}

/// Whether the median point has hardly a step of exactly nothing.
bool repeats_are_rare(const std::vector<Points>& at) {
  std::vector<double> shares;
  for (Eigen::Index p = 0; p < at.front().rows(); ++p) {
    double steps = 0, repeats = 0;
    for (std::size_t k = 0; k + 1 < at.size(); ++k) {
      const double step_m = way_m(at, k, k + 1, p);
      if (!std::isfinite(step_m)) continue;
      ++steps;
      if (step_m == 0) ++repeats;
    }
    if (steps > 0) shares.push_back(repeats / steps);
  }
  return !shares.empty() && median(std::move(shares)) < kRareRepeats;
}

/// The last sample of the readings that equal that of sample `first`. Comparisons with NaN, what is
/// missing, are false.
std::size_t last_equal(const std::vector<Points>& at, std::size_t first, Eigen::Index p) {
  std::size_t last = first;
  while (last + 1 < at.size() && way_m(at, first, last + 1, p) == 0) ++last;
  return last;
}

bool is_elsewhere_at_another_time(const std::vector<Points>& at, const Run& run) {
  for (std::size_t k = 0; k < at.size(); ++k)
    if (way_m(at, run.first, k, run.p) > 0) return true;
  return false;
}

bool points_beside_move(const std::vector<Points>& at, const Run& run, double clearly_m) {
  const auto moves = [&](Eigen::Index q) {
    for (std::size_t k = run.first + 1; k <= run.last; ++k)
      if (way_m(at, run.first, k, q) >= clearly_m) return true;
    return false;
  };
  return std::ranges::count_if(points_beside(at[run.first], run.p), moves) >= kMovingBeside;
}

/// A point that was still starts as smoothly as it moves on.
bool ends_in_a_jump(const std::vector<Points>& at, const Run& run, double clearly_m) {
  const auto& [p, first, last] = run;
  if (last + 1 >= at.size()) return false;
  double beside_m = 0;  // fmax() passes over what is missing
  if (first > 0) beside_m = std::fmax(beside_m, way_m(at, first - 1, first, p));
  if (last + 2 < at.size()) beside_m = std::fmax(beside_m, way_m(at, last + 1, last + 2, p));
  const double jump_m = way_m(at, last, last + 1, p);
  return jump_m >= clearly_m && jump_m > kBeyondStepsBeside * beside_m;
}

}  // namespace

std::vector<HeldReadings> held_readings(const Motion& motion) {
  const std::vector<Points>& at = motion.positions;
  if (at.size() < kLeastHeld) return {};
  const double clearly_m = std::max(kClearly_m, kSmallestSteps * smallest_step_m(at));
  const bool rare = repeats_are_rare(at);
  std::vector<HeldReadings> held;
  for (Eigen::Index p = 0; p < at.front().rows(); ++p)
    for (std::size_t first = 0, last = 0; first < at.size(); first = last + 1) {
      last = last_equal(at, first, p);
      const Run run{p, first, last};
      if (last + 1 - first >= kLeastHeld &&
          motion.time_s[last] - motion.time_s[first] >= kLeastHeld_s - kStaySlack_s &&
          points_beside_move(at, run, clearly_m) && is_elsewhere_at_another_time(at, run) &&
          (rare || ends_in_a_jump(at, run, clearly_m)))
        held.push_back({motion.names[std::size_t(p)], first, last});
    }
  return held;
}

}  // namespace hyperex::motion
