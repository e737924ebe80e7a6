// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/measured_rows.hpp"

#include <algorithm>
#include <limits>

#include "hyperex/geometry/transform.hpp"

namespace hyperex::motion {
namespace {

bool has_reading(const Points& at, int row) {
  return at.row(row).allFinite();
}

bool has_readings_of_all(const Points& at, const std::vector<int>& rows) {
  return std::ranges::all_of(rows, [&](int row) { return has_reading(at, row); });
}

}  // namespace

std::vector<std::size_t> samples_with_all(const Motion& motion, const std::vector<int>& rows) {
  std::vector<std::size_t> samples;
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    if (has_readings_of_all(motion.positions[k], rows)) samples.push_back(k);
  return samples;
}

double longest_gap_s(const Motion& motion, int row) {
  const auto any = [&](const Points& at) { return has_reading(at, row); };
  if (std::ranges::none_of(motion.positions, any)) return std::numeric_limits<double>::infinity();
  double longest_s = 0, from_s = motion.time_s.front();
  bool before = true;
  for (std::size_t k = 0; k < motion.positions.size(); ++k) {
    const bool here = has_reading(motion.positions[k], row);
    if (!before || !here) longest_s = std::max(longest_s, motion.time_s[k] - from_s);
    if (here) from_s = motion.time_s[k];
    before = here;
  }
  return longest_s;
}

std::vector<int> hardly_interrupted(const Motion& motion, const std::vector<int>& rows,
                                    double most_s) {
  constexpr double slack = 1 + 1e-9;
  const std::size_t count = motion.positions.size();
  std::vector<int> some = rows;
  std::erase_if(some, [&](int row) { return longest_gap_s(motion, row) > slack * most_s; });
  std::vector<std::size_t> readings;
  for (const int row : some) readings.push_back(samples_with_all(motion, {row}).size());
  for (;;) {
    const std::size_t complete = samples_with_all(motion, some).size();
    if (complete == count || (complete >= 2 && 2 * complete >= count)) return some;
    const auto fewest = std::ranges::min_element(readings);
    some.erase(some.begin() + (fewest - readings.begin()));
    readings.erase(fewest);
  }
}

bool give_pose_in_gaps(const Motion& motion, const std::vector<int>& rows, double least_spread) {
  for (const Points& at : motion.positions) {
    std::vector<int> both = rows;
    std::erase_if(both, [&](int row) {
      return !has_reading(at, row) || !has_reading(motion.positions.front(), row);
    });
    if (both.size() == rows.size()) continue;
    const Points here = at(both, Eigen::all), first = motion.positions.front()(both, Eigen::all);
    if (std::min(spread_off_line(here), spread_off_line(first)) < least_spread) return false;
  }
  return true;
}

}  // namespace hyperex::motion
