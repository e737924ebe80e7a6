// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/lag.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/core/quantile.hpp"
#include "hyperex/metrics/nan.hpp"
#include "hyperex/motion/resample.hpp"

namespace hyperex::metrics {
namespace {

/// Cubic Hermite interpolation between samples, constant outside.
class Spline {
 public:
  Spline(const std::vector<double>& t, const std::vector<double>& y)
      : t_(t),
        y_(y),
        slope_(motion::spline_slopes(
            t, Eigen::Map<const Eigen::VectorXd>(y.data(), Eigen::Index(y.size())))) {}
  double at(double t) const {
    if (t <= t_.front()) return y_.front();
    if (t >= t_.back()) return y_.back();
    const auto b = static_cast<size_t>(std::upper_bound(t_.begin(), t_.end(), t) - t_.begin());
    const size_t a = b - 1;
    const double h = t_[b] - t_[a], x = (t - t_[a]) / h, z = 1 - x;
    return z * z * (1 + 2 * x) * y_[a] + x * x * (1 + 2 * z) * y_[b] +
           h * x * z * (z * slope_(Eigen::Index(a)) - x * slope_(Eigen::Index(b)));
  }

 private:
  const std::vector<double>&t_, &y_;
  Eigen::VectorXd slope_;
};

double pearson(const std::vector<double>& a, const std::vector<double>& b) {
  const auto count = Eigen::Index(a.size());
  const Eigen::Map<const Eigen::ArrayXd> x(a.data(), count), y(b.data(), count);
  const Eigen::ArrayXd dx = x - x.mean(), dy = y - y.mean();
  const double scale = std::sqrt(dx.square().sum() * dy.square().sum());
  return scale > 0 ? (dx * dy).sum() / scale : kNan;
}

/// Whether the values vary by more than rounding.
bool varies(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return *most - *least > 1e-12 * std::max(std::abs(*least), std::abs(*most));
}

}  // namespace

Lag lag_of(const std::vector<double>& time_s, const std::vector<double>& input,
           const std::vector<double>& response, double most_lag_s) {
  if (input.size() != time_s.size() || response.size() != time_s.size())
    throw std::invalid_argument("lag_of: as many inputs and responses as times are needed");
  if (!(most_lag_s > 0)) throw std::invalid_argument("lag_of: the largest lag must be above 0");
  std::vector<double> at, in;
  for (size_t i = 0; i < time_s.size(); ++i)
    if (time_s[i] - most_lag_s >= time_s.front() && time_s[i] + most_lag_s <= time_s.back()) {
      at.push_back(time_s[i]);
      in.push_back(input[i]);
    }
  if (at.size() < 8 || !varies(in) || !varies(response)) return {kNan, kNan, false};
  const Spline spline(time_s, response);
  std::vector<double> out(at.size());
  const auto likeness = [&](double lag) {
    for (size_t i = 0; i < at.size(); ++i) out[i] = spline.at(at[i] + lag);
    return pearson(in, out);
  };
  const int half = std::max(1, int(std::ceil(most_lag_s / (0.25 * median_step(time_s)))));
  const double grid = most_lag_s / half;
  Lag best{kNan, kNan, false};
  for (int k = -half; k <= half; ++k)
    if (const double c = likeness(k * grid); !(c <= best.correlation) && !std::isnan(c)) {
      best.lag_s = k * grid;
      best.correlation = c;
      best.at_limit = std::abs(k) == half;
    }
  if (std::isnan(best.correlation) || best.at_limit) return best;
  for (double h = grid; h > 1e-4 * grid; h /= 4) {
    const double left = likeness(best.lag_s - h), middle = likeness(best.lag_s),
                 right = likeness(best.lag_s + h), bend = left - 2 * middle + right;
    if (!(bend < 0)) break;
    best.lag_s += std::clamp(0.5 * h * (left - right) / bend, -h, h);
  }
  best.correlation = likeness(best.lag_s);
  return best;
}

double hysteresis_of(const std::vector<double>& input, const std::vector<double>& response) {
  if (input.size() != response.size())
    throw std::invalid_argument("hysteresis_of: as many responses as inputs are needed");
  if (input.empty()) return kNan;
  const auto [least_i, most_i] = std::minmax_element(input.begin(), input.end());
  const auto [least_r, most_r] = std::minmax_element(response.begin(), response.end());
  const double box = (*most_i - *least_i) * (*most_r - *least_r);
  if (!(box > 0)) return kNan;
  double twice = 0;
  for (size_t k = 0; k < input.size(); ++k) {
    const size_t next = (k + 1) % input.size();
    // Relative to the first point, to reduce rounding errors.
    twice += (input[k] - input[0]) * (response[next] - response[0]) -
             (input[next] - input[0]) * (response[k] - response[0]);
  }
  return std::abs(0.5 * twice) / box;
}

std::vector<double> along_farthest(const Points& positions) {
  std::vector<double> out(static_cast<size_t>(positions.rows()), 0);
  if (positions.rows() == 0) return out;
  const Points moved = positions.rowwise() - positions.row(0).eval();
  Eigen::Index farthest = 0;
  const double length = moved.rowwise().norm().maxCoeff(&farthest);
  if (!(length > 0)) return out;
  const Vec3 direction = moved.row(farthest).transpose() / length;
  for (Eigen::Index k = 0; k < moved.rows(); ++k)
    out[static_cast<size_t>(k)] = moved.row(k) * direction;
  return out;
}

}  // namespace hyperex::metrics
