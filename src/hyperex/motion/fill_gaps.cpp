// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/fill_gaps.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/core/assert.hpp"
#include "hyperex/motion/option_error.hpp"

namespace hyperex::motion {

namespace {

bool measured(const Motion& motion, int sample, int point) {
  return motion.positions[std::size_t(sample)].row(point).allFinite();
}

void check_steps(const Motion& motion, double max_gap_s) {
  std::vector<double> steps;
  for (std::size_t i = 1; i < motion.time_s.size(); ++i)
    steps.push_back(motion.time_s[i] - motion.time_s[i - 1]);
  if (steps.empty()) return;
  std::vector<double> sorted = steps;
  std::nth_element(sorted.begin(), sorted.begin() + long(sorted.size() / 2), sorted.end());
  const double usual = sorted[sorted.size() / 2];
  for (std::size_t i = 0; i < steps.size(); ++i)
    if (steps[i] > max_gap_s && steps[i] > 5 * usual)
      refuse(motion, fmt::format("no samples from {:.4g} s on for {:.4g} s: at most {:.4g} s are "
                                 "interpolated",
                                 motion.time_s[i], steps[i], max_gap_s));
}

/// Slope of a point at a measured sample, towards its neighbour on the side away from the gap; zero
/// where that neighbour is not measured.
Eigen::RowVector3d slope(const Motion& motion, int point, int sample, int away) {
  const int other = sample + away;
  if (other < 0 || other >= int(motion.time_s.size()) || !measured(motion, other, point))
    return Eigen::RowVector3d::Zero();
  return (motion.positions[std::size_t(sample)].row(point) -
          motion.positions[std::size_t(other)].row(point)) /
         (motion.time_s[std::size_t(sample)] - motion.time_s[std::size_t(other)]);
}

/// Writes samples first..last of `point` from the measured samples around them.
void fill(const Motion& from, Motion& to, int point, int first, int last, GapFill how) {
  const int count = int(from.time_s.size()), before = first - 1, after = last + 1;
  for (int k = first; k <= last; ++k) {
    auto row = to.positions[std::size_t(k)].row(point);
    if (before < 0 || after >= count) {
      row = from.positions[std::size_t(before < 0 ? after : before)].row(point);
      continue;
    }
    const double span = from.time_s[std::size_t(after)] - from.time_s[std::size_t(before)];
    const double u = (from.time_s[std::size_t(k)] - from.time_s[std::size_t(before)]) / span;
    const Eigen::RowVector3d a = from.positions[std::size_t(before)].row(point),
                             b = from.positions[std::size_t(after)].row(point);
    if (how == GapFill::linear) {
      row = (1 - u) * a + u * b;
    } else {
      const double v = 1 - u;
      row = (1 + 2 * u) * v * v * a + u * u * (3 - 2 * u) * b +
            span * (u * v * v * slope(from, point, before, -1) -
                    u * u * v * slope(from, point, after, 1));
    }
  }
}

}  // namespace

FilledMotion fill_gaps(const Motion& motion, const GapOptions& options) {
  HX_ASSERT(options.max_gap_s >= 0);
  check_steps(motion, options.max_gap_s);
  const int count = int(motion.time_s.size());
  FilledMotion result{motion, {}};
  for (int p = 0; p < int(motion.names.size()); ++p) {
    for (int k = 0; k < count; ++k) {
      if (measured(motion, k, p)) continue;
      int last = k;
      while (last + 1 < count && !measured(motion, last + 1, p)) ++last;
      const std::string& name = motion.names[std::size_t(p)];
      if (k == 0 && last == count - 1) refuse(motion, "point " + name + " has no sample at all");
      const double from_s = motion.time_s[std::size_t(std::max(k - 1, 0))];
      const double length_s = motion.time_s[std::size_t(std::min(last + 1, count - 1))] - from_s;
      if (length_s > options.max_gap_s * (1 + 1e-9))
        throw OptionError(
            named(motion),
            fmt::format("point {} is missing from {:.4g} s on for {:.4g} s: at most {:.4g} s are "
                        "interpolated (",
                        name, motion.time_s[std::size_t(k)], length_s, options.max_gap_s),
            "max_gap_s", ")");
      fill(motion, result.motion, p, k, last, options.fill);
      result.gaps.push_back(
          {name, motion.time_s[std::size_t(k)], motion.time_s[std::size_t(last)], last - k + 1});
      k = last;
    }
  }
  return result;
}

}  // namespace hyperex::motion
