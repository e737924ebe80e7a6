// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/closed_line.hpp"

#include <algorithm>
#include <limits>

namespace hyperex {

double distance_to_closed_line(const Eigen::RowVector3d& point, const Points& line) {
  double least = std::numeric_limits<double>::infinity();
  for (Eigen::Index i = 0; i < line.rows(); ++i) {
    const Eigen::RowVector3d from = line.row(i), along = line.row((i + 1) % line.rows()) - from;
    const double squared = along.squaredNorm();
    const double at = squared > 0 ? std::clamp((point - from).dot(along) / squared, 0.0, 1.0) : 0.0;
    least = std::min(least, (point - from - at * along).norm());
  }
  return least;
}

}  // namespace hyperex
