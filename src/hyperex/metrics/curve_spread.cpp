// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/curve_spread.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace hyperex::metrics {

std::vector<double> signed_difference(const SymmetryCurve& curve) {
  std::vector<double> difference(curve.time_s.size());
  for (std::size_t k = 0; k < difference.size(); ++k)
    difference[k] = curve.xi_left[k] - curve.xi_right[k];
  return difference;
}

std::vector<double> added_difference(const SymmetryCurve& curve, const SymmetryCurve& own) {
  std::vector<double> added = signed_difference(curve);
  const std::vector<double> before = signed_difference(own);
  if (added.size() != before.size())
    throw std::invalid_argument("curves of different numbers of samples");
  for (std::size_t k = 0; k < added.size(); ++k) added[k] -= before[k];
  return added;
}

std::vector<double> spread_of(const std::vector<SymmetryCurve>& curves, double clear) {
  if (curves.empty()) throw std::invalid_argument("spread of no curves");
  std::vector<double> spread(curves.front().time_s.size());
  for (const SymmetryCurve& curve : curves)
    if (curve.time_s.size() != spread.size())
      throw std::invalid_argument("curves of different numbers of samples");
  for (std::size_t k = 0; k < spread.size(); ++k) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const SymmetryCurve& curve : curves) {
      const double size = std::abs(curve.xi_left[k] - curve.xi_right[k]);
      // NaN must be propagated to both bounds; std::min and std::max would ignore it.
      const double s = size >= clear * curve.floor ? std::log(size) : std::nan("");
      low = std::isnan(s) ? s : std::isnan(low) ? low : std::min(low, s);
      high = std::isnan(s) ? s : std::isnan(high) ? high : std::max(high, s);
    }
    spread[k] = high - low;
  }
  return spread;
}

double share_between(const std::vector<double>& time_s, const std::vector<double>& value,
                     double from_s, double to_s) {
  if (time_s.size() != value.size()) throw std::invalid_argument("times and values differ");
  double all = 0, inside = 0;
  for (std::size_t k = 1; k < time_s.size(); ++k) {
    const double t0 = time_s[k - 1], t1 = time_s[k];
    const double a = std::abs(value[k - 1]), b = std::abs(value[k]);
    if (std::isnan(a) || std::isnan(b)) continue;
    const auto at = [&](double t) { return a + (b - a) * (t - t0) / (t1 - t0); };
    all += 0.5 * (a + b) * (t1 - t0);
    const double low = std::max(t0, from_s), high = std::min(t1, to_s);
    if (low < high) inside += 0.5 * (at(low) + at(high)) * (high - low);
  }
  return all > 0 ? inside / all : std::nan("");
}

int greatest_sample(const std::vector<double>& value) {
  int best = -1;
  for (std::size_t k = 0; k < value.size(); ++k)
    if (!std::isnan(value[k]) &&
        (best < 0 || std::abs(value[k]) > std::abs(value[std::size_t(best)])))
      best = int(k);
  return best;
}

}  // namespace hyperex::metrics
