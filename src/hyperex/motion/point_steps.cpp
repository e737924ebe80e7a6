// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/point_steps.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hyperex/core/quantile.hpp"

namespace hyperex::motion {

double way_m(const std::vector<Points>& at, std::size_t a, std::size_t b, Eigen::Index p) {
  return (at[b].row(p) - at[a].row(p)).norm();
}

double bend_m(const std::vector<Points>& at, std::size_t k, Eigen::Index p) {
  return (at[k].row(p) - 0.5 * (at[k - 1].row(p) + at[k + 1].row(p))).norm();
}

double usual_bend_m(const std::vector<Points>& at, Eigen::Index p) {
  std::vector<double> all;
  for (std::size_t k = 1; k + 1 < at.size(); ++k)
    if (const double bend = bend_m(at, k, p); std::isfinite(bend)) all.push_back(bend);
  return all.empty() ? std::numeric_limits<double>::infinity() : median(std::move(all));
}

double usual_bend_without_m(const std::vector<Points>& at, std::size_t k, Eigen::Index p) {
  std::vector<double> others;
  for (std::size_t i = 1; i + 1 < at.size(); ++i)
    if (const double bend = bend_m(at, i, p); (i + 1 < k || i > k + 1) && std::isfinite(bend))
      others.push_back(bend);
  return others.empty() ? 0 : median(std::move(others));
}

std::vector<Eigen::Index> points_beside(const Points& at, Eigen::Index p) {
  constexpr std::size_t most = 4;
  std::vector<std::pair<double, Eigen::Index>> far;
  for (Eigen::Index q = 0; q < at.rows(); ++q)
    if (const double far_m = (at.row(q) - at.row(p)).norm(); q != p && std::isfinite(far_m))
      far.emplace_back(far_m, q);
  const std::size_t count = std::min(most, far.size());
  std::partial_sort(far.begin(), far.begin() + std::ptrdiff_t(count), far.end());
  std::vector<Eigen::Index> beside;
  for (std::size_t i = 0; i < count; ++i) beside.push_back(far[i].second);
  return beside;
}

}  // namespace hyperex::motion
