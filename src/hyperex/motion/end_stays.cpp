// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/end_stays.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "hyperex/core/quantile.hpp"
#include "hyperex/motion/brief_stays.hpp"
#include "hyperex/motion/point_steps.hpp"
#include "hyperex/motion/stays.hpp"

namespace hyperex::motion {
namespace {

constexpr std::size_t kStepsBefore = 3;
constexpr double kReturn_s = 0.6;  // twice as long as a stay lasts (kLongestStay_s)

/// The readings of a point from one end of the recording inward.
struct InwardPath {
  const std::vector<Points>& at;
  const std::vector<double>& time_s;
  Eigen::Index point;
  std::vector<std::size_t> samples;  ///< those that are measured, the outermost first

  double step_m(std::size_t i) const { return way_m(at, samples[i], samples[i + 1], point); }
  double apart_m(std::size_t i, std::size_t j) const {
    return way_m(at, samples[i], samples[j], point);
  }
  double apart_s(std::size_t i, std::size_t j) const {
    return std::abs(time_s[samples[i]] - time_s[samples[j]]);
  }
};

/// Whether the first `count` readings are away from the next one by a jump that stands alone in the
/// point's own path.
bool jumps_alone(const InwardPath& path, std::size_t count) {
  const double jump_m = path.step_m(count - 1);
  double beside_m = 0;
  for (std::size_t i = 0; i + 1 < count; ++i) beside_m = std::max(beside_m, path.step_m(i));
  const std::size_t inner = std::min(count + kStepsBefore, path.samples.size() - 1);
  for (std::size_t i = count; i < inner; ++i) beside_m = std::max(beside_m, path.step_m(i));
  if (jump_m <= 3 * beside_m) return false;
  for (std::size_t i = 0; i < count; ++i)
    if (path.apart_m(i, count) <= jump_m / 2) return false;
  // A way back to where the point was before is none away.
  for (std::size_t i = count; i < path.samples.size() && path.apart_s(i, count) <= kReturn_s; ++i)
    if (path.apart_m(i, count - 1) <= jump_m / 2) return false;
  return true;
}

/// By the readings that are not away. Where there are too few of them, none is usual.
bool exceeds_usual_bends(const InwardPath& path, std::size_t count) {
  std::vector<double> bends;
  for (std::size_t i = count + 1; i + 1 < path.samples.size(); ++i) {
    const auto place = [&](std::size_t j) { return path.at[path.samples[j]].row(path.point); };
    bends.push_back((place(i) - 0.5 * (place(i - 1) + place(i + 1))).norm());
  }
  return bends.empty() || path.step_m(count - 1) > 8 * median(std::move(bends));
}

bool others_jump_too(const InwardPath& path, std::size_t count) {
  const std::size_t away = path.samples[count - 1], before = path.samples[count];
  return std::ranges::any_of(points_beside(path.at[before], path.point), [&](Eigen::Index q) {
    return way_m(path.at, before, away, q) >= path.step_m(count - 1) / 3;
  });
}

std::optional<EndStay> stay_at_end(const InwardPath& path, const EndRule& rule) {
  for (std::size_t count = 1; count + 1 < path.samples.size(); ++count) {
    const double lasts_s = path.apart_s(0, count);
    if (count > 1 && lasts_s > rule.longest_s + kStaySlack_s) break;
    const double jump_m = path.step_m(count - 1), step_s = path.apart_s(count - 1, count);
    if (!(jump_m > rule.least_m) || step_s > rule.longest_step_s || !jumps_alone(path, count) ||
        others_jump_too(path, count) || !exceeds_usual_bends(path, count))
      continue;
    EndStay stay{path.point, {}, 0, jump_m, jump_m / step_s, lasts_s};
    stay.samples.assign(path.samples.begin(), path.samples.begin() + std::ptrdiff_t(count));
    stay.jump = std::max(path.samples[count - 1], path.samples[count]);
    std::ranges::sort(stay.samples);
    return stay;
  }
  return std::nullopt;
}

}  // namespace

std::vector<EndStay> end_stays(const std::vector<Points>& at, const std::vector<double>& time_s,
                               const std::vector<std::string>& names, const EndRule& rule) {
  std::vector<EndStay> found;
  for (std::size_t n = 0; n < names.size(); ++n) {
    if (is_of_lid(names[n])) continue;
    InwardPath path{at, time_s, Eigen::Index(n), {}};
    for (std::size_t k = 0; k < at.size(); ++k)
      if (at[k].row(path.point).allFinite()) path.samples.push_back(k);
    auto start = stay_at_end(path, rule);
    std::ranges::reverse(path.samples);
    auto end = stay_at_end(path, rule);
    for (auto* stay : {&start, &end})
      if (*stay) found.push_back(std::move(**stay));
  }
  return found;
}

}  // namespace hyperex::motion
