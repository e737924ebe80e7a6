// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/observation.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"

namespace hyperex::estimate {
namespace {

/// Samples this near to the peak count to it.
constexpr double kNearPeak = 0.95;
/// A recording that moves less has no expression.
constexpr double kLeastMotion_m = 5e-4;

Eigen::VectorXd displacement(const motion::Motion& motion, const std::vector<int>& rows,
                             std::size_t sample) {
  Eigen::VectorXd out(3 * Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.segment<3>(3 * Eigen::Index(i)) =
        (motion.positions[sample].row(rows[i]) - motion.positions.front().row(rows[i])).transpose();
  return out;
}

}  // namespace

Observation observe(const simulate::AlignedMotion& recording,
                    const std::vector<std::string>& points, const RecordingErrors& errors,
                    const std::string& name) {
  const motion::Motion& motion = recording.motion;
  std::vector<int> rows;
  for (const std::string& point : points) rows.push_back(motion.index_of(point));
  std::vector<double> moved;
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    moved.push_back(displacement(motion, rows, k).norm() / std::sqrt(double(rows.size())));
  const auto peak = std::size_t(std::max_element(moved.begin(), moved.end()) - moved.begin());
  if (moved[peak] < kLeastMotion_m)
    throw InputError(name, "expected a recording in which the points move by 0.5 mm or more");
  std::size_t from = peak, to = peak;
  while (from > 1 && moved[from - 1] >= kNearPeak * moved[peak]) --from;
  while (to + 1 < moved.size() && moved[to + 1] >= kNearPeak * moved[peak]) ++to;
  Observation out;
  out.name = name;
  out.displacement_m = Eigen::VectorXd::Zero(3 * Eigen::Index(rows.size()));
  for (std::size_t k = from; k <= to; ++k) out.displacement_m += displacement(motion, rows, k);
  const double samples = double(to - from + 1);
  out.displacement_m /= samples;
  out.time_s = motion.time_s[peak] - motion.time_s.front();
  out.noise_m = errors.jitter_m * std::sqrt(1 + 1 / samples);
  out.head_turn_rad = errors.head_turn_rad;
  out.head_shift_m = errors.head_shift_m;
  return out;
}

}  // namespace hyperex::estimate
