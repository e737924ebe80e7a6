// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/jitter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "hyperex/core/quantile.hpp"

namespace hyperex::motion {
namespace {

constexpr std::size_t kOrder = 4, kFewestSamples = 20, kFewestDifferences = 5;
constexpr double kMedianOfNormal = 0.6745;  // median absolute value of a standard normal variable
using Weights = std::array<double, kOrder + 1>;

/// Weights of the fourth divided difference at these times, scaled so that white noise keeps its
/// variance: at even times (1, -4, 6, -4, 1) / sqrt(70).
Weights weights_at(const std::vector<double>& time_s, std::size_t first, std::size_t stride) {
  Weights weights;
  const double length = time_s[first + kOrder * stride] - time_s[first];
  double squares = 0;
  for (std::size_t i = 0; i <= kOrder; ++i) {
    weights[i] = 1;
    for (std::size_t j = 0; j <= kOrder; ++j)
      if (j != i) weights[i] *= length / (time_s[first + i * stride] - time_s[first + j * stride]);
    squares += weights[i] * weights[i];
  }
  for (double& weight : weights) weight /= std::sqrt(squares);
  return weights;
}

/// Fourth differences of a point, one row each. Differences with a sample that is not measured are
/// left out.
std::vector<Eigen::RowVector3d> differences(const Motion& motion, int column, std::size_t stride) {
  std::vector<Eigen::RowVector3d> out;
  for (std::size_t k = 0; k + kOrder * stride < motion.positions.size(); ++k) {
    const Weights weights = weights_at(motion.time_s, k, stride);
    Eigen::RowVector3d difference = Eigen::RowVector3d::Zero();
    for (std::size_t i = 0; i <= kOrder; ++i)
      difference += weights[i] * motion.positions[k + i * stride].row(column);
    if (difference.allFinite()) out.push_back(difference);
  }
  return out;
}

/// The mean over columns and axes of the variance estimated from the medians of their differences;
/// NaN where there are too few.
double variance_of(const Motion& motion, const std::vector<int>& columns, std::size_t stride) {
  double sum = 0, count = 0;
  for (const int column : columns) {
    const auto some = differences(motion, column, stride);
    if (some.size() < kFewestDifferences) continue;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
      std::vector<double> sizes;
      for (const auto& difference : some) sizes.push_back(std::abs(difference[axis]));
      const double deviation = median(sizes) / kMedianOfNormal;
      sum += deviation * deviation;
      ++count;
    }
  }
  return sum / count;
}

}  // namespace

double jitter_of_differences(const Motion& motion, const std::vector<int>& columns) {
  std::vector<double> sizes;
  for (const int column : columns)
    for (const auto& difference : differences(motion, column, 1))
      for (Eigen::Index axis = 0; axis < 3; ++axis) sizes.push_back(std::abs(difference[axis]));
  return sizes.empty() ? 0 : median(sizes) / kMedianOfNormal;
}

double jitter_of_motion(const Motion& motion, const std::vector<int>& columns) {
  if (motion.positions.size() < kFewestSamples) return std::numeric_limits<double>::quiet_NaN();
  constexpr double growth =
      256;  // squared differences of a smooth motion at twice the step: (2^4)^2
  const double near = variance_of(motion, columns, 1), far = variance_of(motion, columns, 2);
  const double variance = (growth * near - far) / (growth - 1);
  return std::sqrt(variance < 0 ? 0 : variance);
}

}  // namespace hyperex::motion
