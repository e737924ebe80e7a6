// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/pose_floor.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/within_95.hpp"
#include "hyperex/metrics/lowpass.hpp"
#include "hyperex/metrics/point_pairs.hpp"

namespace hyperex::metrics {
namespace {

using Row6 = Eigen::Matrix<double, 1, 6>;

/// How a point's greatest excursion changes with an error of the pose in that sample.
struct Sensitivity {
  std::size_t sample = 0;
  Row6 row = Row6::Zero();
};

Sensitivity sensitivity_of(const motion::Motion& steady,
                           const std::vector<motion::UncertainPose>& poses, int column) {
  Sensitivity out;
  double most = 0;
  const Vec3 rest = steady.positions.front().row(column).transpose();
  for (std::size_t k = 1; k < steady.positions.size(); ++k) {
    const Vec3 p = steady.positions[k].row(column).transpose();
    const double moved = (p - rest).norm();
    if (!(moved > most)) continue;
    most = moved;
    out.sample = k;
    out.row = (p - rest).transpose() / moved * motion::pose_derivative(p - poses[k].centre);
  }
  return out;
}

}  // namespace

double excursion_pose_floor_mm(const motion::Motion& steady,
                               const std::vector<motion::UncertainPose>& poses, int left, int right,
                               double lowpass_hz) {
  if (poses.size() != steady.positions.size() || poses.empty()) return 0;
  const Sensitivity l = sensitivity_of(steady, poses, left),
                    r = sensitivity_of(steady, poses, right);
  const auto variance = [&](const Row6& row, std::size_t sample) -> double {
    const double share = jitter_left(steady.time_s, sample, lowpass_hz);
    return row * poses[sample].filtered(share) * row.transpose();
  };
  const double all = l.sample == r.sample ? variance(l.row - r.row, l.sample)
                                          : variance(l.row, l.sample) + variance(r.row, r.sample);
  return 1e3 * kWithin95 * std::sqrt(std::max(0.0, all));
}

std::map<std::string, double> pose_floors_mm(const motion::Motion& steady,
                                             const std::vector<motion::UncertainPose>& poses,
                                             double lowpass_hz) {
  std::map<std::string, double> floors;
  for (const PointPair& pair : point_pairs(steady))
    floors[pair.name] = excursion_pose_floor_mm(steady, poses, pair.left, pair.right, lowpass_hz);
  return floors;
}

void add_pose_floors(Excursions& excursions, const std::map<std::string, double>& floors_mm) {
  double most = 0;
  for (const auto& [name, floor] : floors_mm) most = std::max(most, floor);
  for (PairExcursion& pair : excursions.pairs) {
    const auto own = floors_mm.find(pair.name);
    pair.pose_floor_mm = own != floors_mm.end() ? own->second : most;
    pair.judge();
  }
}

}  // namespace hyperex::metrics
