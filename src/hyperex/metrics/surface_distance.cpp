// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/surface_distance.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>

#include "hyperex/core/quantile.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::metrics {
namespace {

/// Sorts like std::sort, but several times as fast for thousands of values: a radix sort with
/// eleven bits per pass. Non-negative doubles have the same order as their bit patterns.
void sort_distances(std::vector<double>& values) {
  constexpr int digit_bits = 11;
  constexpr std::size_t worthwhile = 1000, digits = std::size_t(1) << digit_bits;
  const auto plain = [](double value) { return !std::signbit(value) && std::isfinite(value); };
  if (values.size() < worthwhile || !std::all_of(values.begin(), values.end(), plain)) {
    std::sort(values.begin(), values.end());
    return;
  }
  std::vector<double> sorted(values.size());
  for (int shift = 0; shift < 64; shift += digit_bits) {
    const auto digit = [&](double value) {
      return std::size_t(std::bit_cast<std::uint64_t>(value) >> shift) % digits;
    };
    std::array<std::size_t, digits + 1> place{};
    for (const double value : values) ++place[digit(value) + 1];
    // All values have the same digit.
    if (place[digit(values.front()) + 1] == values.size()) continue;
    for (std::size_t d = 1; d < digits; ++d) place[d] += place[d - 1];
    for (const double value : values) sorted[place[digit(value)]++] = value;
    values.swap(sorted);
  }
}

DistanceStatistics summary(std::vector<double> values_m) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (values_m.empty()) return {nan, nan, nan, nan, nan, 0};
  sort_distances(values_m);
  double sum = 0, squares = 0;
  for (const double value : values_m) {
    sum += value;
    squares += value * value;
  }
  const double n = static_cast<double>(values_m.size());
  return {1e3 * sum / n,
          1e3 * quantile_of_sorted(values_m, 0.5),
          1e3 * std::sqrt(squares / n),
          1e3 * quantile_of_sorted(values_m, 0.95),
          1e3 * values_m.back(),
          static_cast<Eigen::Index>(values_m.size())};
}

}  // namespace

DistanceStatistics statistics_of(const Eigen::VectorXd& distance_m) {
  return summary({distance_m.begin(), distance_m.end()});
}

DistanceStatistics statistics_of(const Eigen::VectorXd& distance_m,
                                 const std::vector<int>& vertices) {
  std::vector<double> values;
  values.reserve(vertices.size());
  for (const int vertex : vertices) values.push_back(distance_m[vertex]);
  return summary(std::move(values));
}

Eigen::VectorXd distance_to_surface(const Points& a, const TriMesh& b) {
  const auto found = SurfaceTree(b).query_all(a);
  Eigen::VectorXd distance(a.rows());
  for (Eigen::Index i = 0; i < a.rows(); ++i) distance[i] = std::sqrt(found[i].squared_distance);
  return distance;
}

Eigen::VectorXd distance_to_corresponding(const Points& a, const Points& b, Eigen::Index count) {
  if (a.rows() < count || b.rows() < count)
    throw std::invalid_argument("corresponding points: one surface has too few");
  return (a.topRows(count) - b.topRows(count)).rowwise().norm();
}

}  // namespace hyperex::metrics
