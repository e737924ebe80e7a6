// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/condensed_inverse.hpp"

#include <algorithm>

namespace hyperex::fem {
namespace {
constexpr Eigen::Index kTogether = 96;  // columns solved at a time
}

Eigen::MatrixXd condensed_inverse(PartitionedFactor& factor, const std::vector<int>& nodes) {
  const std::vector<int>& free = factor.free();
  std::vector<Eigen::Index> row, place;  // among the free unknowns; in the result
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) {
      const int unknown = 3 * nodes[i] + axis;
      const auto at = std::lower_bound(free.begin(), free.end(), unknown);
      if (at == free.end() || *at != unknown) continue;
      row.push_back(at - free.begin());
      place.push_back(3 * Eigen::Index(i) + axis);
    }
  const auto count = Eigen::Index(row.size());
  const auto all = 3 * Eigen::Index(nodes.size());
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(all, all);
  Eigen::MatrixXd columns;
  for (Eigen::Index from = 0; from < count; from += kTogether) {
    const Eigen::Index width = std::min(kTogether, count - from);
    columns.setZero(Eigen::Index(free.size()), width);
    for (Eigen::Index c = 0; c < width; ++c) columns(row[std::size_t(from + c)], c) = 1;
    factor.solve(columns);
    for (Eigen::Index c = 0; c < width; ++c)
      for (Eigen::Index r = 0; r < count; ++r)
        out(place[std::size_t(r)], place[std::size_t(from + c)]) = columns(row[std::size_t(r)], c);
  }
  return 0.5 * (out + out.transpose());
}

}  // namespace hyperex::fem
