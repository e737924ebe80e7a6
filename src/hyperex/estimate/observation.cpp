// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/observation.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/error.hpp"

namespace hyperex::estimate {
namespace {

/// Samples next to the peak with this share of its displacement or more count as the peak.
constexpr double kNearPeak = 0.95;
/// A recording that moves less has no expression.
constexpr double kLeastMotion_m = 5e-4;
/// The last such share of the samples counts as loaded.
constexpr double kEnding = 0.1;
/// So do samples that have gone this share of the way to the mean of the last ones.
constexpr double kHeld = 0.8;

Eigen::VectorXd displacement(const motion::Motion& motion, const std::vector<int>& rows,
                             std::size_t sample) {
  Eigen::VectorXd out(3 * Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i)
    out.segment<3>(3 * Eigen::Index(i)) =
        (motion.positions[sample].row(rows[i]) - motion.positions.front().row(rows[i])).transpose();
  return out;
}

/// Distance of each sample from the first one: root mean square over the points, m.
std::vector<double> distances(const motion::Motion& motion, const std::vector<int>& rows) {
  std::vector<double> out;
  for (std::size_t k = 0; k < motion.positions.size(); ++k)
    out.push_back(displacement(motion, rows, k).norm() / std::sqrt(double(rows.size())));
  return out;
}

std::vector<int> rows_of(const motion::Motion& motion, const std::vector<std::string>& points) {
  std::vector<int> out;
  for (const std::string& point : points) out.push_back(motion.index_of(point));
  return out;
}

/// The mean over some samples.
Observation mean_of(const motion::Motion& motion, const std::vector<int>& rows,
                    const std::vector<std::size_t>& samples, const RecordingErrors& errors,
                    const std::string& name) {
  Observation out;
  out.name = name;
  out.displacement_m = Eigen::VectorXd::Zero(3 * Eigen::Index(rows.size()));
  for (const std::size_t k : samples) out.displacement_m += displacement(motion, rows, k);
  out.displacement_m /= double(samples.size());
  out.samples = int(samples.size());
  out.noise_m = errors.jitter_m * std::sqrt(1 + 1 / double(samples.size()));
  out.head_turn_rad = errors.head_turn_rad;
  out.head_shift_m = errors.head_shift_m;
  return out;
}

}  // namespace

Observation observe(const simulate::AlignedMotion& recording,
                    const std::vector<std::string>& points, const RecordingErrors& errors,
                    const std::string& name) {
  const motion::Motion& motion = recording.motion;
  const std::vector<int> rows = rows_of(motion, points);
  const std::vector<double> moved = distances(motion, rows);
  const auto peak = std::size_t(std::max_element(moved.begin(), moved.end()) - moved.begin());
  if (moved[peak] < kLeastMotion_m)
    throw InputError(name, "expected a recording in which the points move by 0.5 mm or more");
  std::size_t from = peak, to = peak;
  while (from > 1 && moved[from - 1] >= kNearPeak * moved[peak]) --from;
  while (to + 1 < moved.size() && moved[to + 1] >= kNearPeak * moved[peak]) ++to;
  std::vector<std::size_t> samples;
  for (std::size_t k = from; k <= to; ++k) samples.push_back(k);
  Observation out = mean_of(motion, rows, samples, errors, name);
  out.time_s = motion.time_s[peak] - motion.time_s.front();
  return out;
}

Observation observe_load(const simulate::AlignedMotion& recording,
                         const std::vector<std::string>& points, const RecordingErrors& errors,
                         const std::string& name) {
  const motion::Motion& motion = recording.motion;
  const std::vector<int> rows = rows_of(motion, points);
  const std::size_t count = motion.positions.size();
  const auto ending = std::size_t(std::ceil(kEnding * double(count - 1)));
  std::vector<std::size_t> last;
  for (std::size_t k = count - ending; k < count; ++k) last.push_back(k);
  const Eigen::VectorXd end = mean_of(motion, rows, last, errors, name).displacement_m;
  std::vector<std::size_t> samples;
  for (std::size_t k = 1; k < count; ++k)
    if (k + ending >= count || displacement(motion, rows, k).dot(end) >= kHeld * end.squaredNorm())
      samples.push_back(k);
  Observation out = mean_of(motion, rows, samples, errors, name);
  out.time_s = motion.time_s[samples.front()] - motion.time_s.front();
  return out;
}

}  // namespace hyperex::estimate
