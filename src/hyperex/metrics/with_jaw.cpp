// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/with_jaw.hpp"

#include <algorithm>
#include <cmath>

namespace hyperex::metrics {

double with_jaw_mm(const std::vector<Eigen::Isometry3d>& jaw_now_from_rest,
                   const motion::Motion& motion, int column) {
  if (column < 0 || column >= int(motion.names.size()) || motion.positions.empty() ||
      jaw_now_from_rest.empty())
    return std::nan("");
  const Vec3 first = motion.positions[0].row(column).transpose();
  // Surgery may have moved the jaw before the first sample.
  const Vec3 on_jaw = jaw_now_from_rest[0].inverse() * first;
  double most_m = 0;
  for (const Eigen::Isometry3d& pose : jaw_now_from_rest)
    most_m = std::max(most_m, (pose * on_jaw - first).norm());
  return 1e3 * most_m;
}

std::vector<Eigen::Isometry3d> turned_about(std::vector<Eigen::Isometry3d> jaw_now_from_rest,
                                            const Vec3& joint) {
  if (jaw_now_from_rest.empty()) return jaw_now_from_rest;
  const Vec3 first = jaw_now_from_rest[0] * joint;
  for (Eigen::Isometry3d& pose : jaw_now_from_rest) pose.pretranslate(first - pose * joint);
  return jaw_now_from_rest;
}

}  // namespace hyperex::metrics
