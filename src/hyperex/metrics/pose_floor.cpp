// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/pose_floor.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/core/within_95.hpp"
#include "hyperex/metrics/point_pairs.hpp"
#include "hyperex/motion/lowpass.hpp"

namespace hyperex::metrics {
namespace {

using Row6 = Eigen::Matrix<double, 1, 6>;

/// How a point's greatest excursion changes with an error of the pose in that sample.
struct Sensitivity {
  std::size_t sample = 0;
  Row6 row = Row6::Zero();
};

Sensitivity sensitivity_of(const motion::Motion& steady,
                           const std::vector<motion::UncertainPose>& poses, int column,
                           double lowpass_hz) {
  Sensitivity out;
  double most = 0;
  const Points track =
      motion::lowpassed(steady.time_s, motion::track_of(steady, column), lowpass_hz).value;
  for (std::size_t k = 1; k < steady.positions.size(); ++k) {
    const Vec3 p = track.row(Eigen::Index(k)).transpose();
    const Vec3 way = p - track.row(0).transpose();
    const double moved = way.norm();
    if (!(moved > most)) continue;
    most = moved;
    out.sample = k;
    out.row = 1e3 * way.transpose() / moved * motion::pose_derivative(p - poses[k].centre);
  }
  return out;
}

PoseVariance variance_of(const Row6& row, const motion::UncertainPose& pose) {
  return {std::max(0.0, (row * pose.covariance * row.transpose()).value()),
          std::max(0.0, (row * pose.of_jitter * row.transpose()).value())};
}

/// What is left of the variance where the filter leaves a share of the jitter.
double floor_mm(const PoseVariance& variance, double jitter_share) {
  return kWithin95 *
         std::sqrt(std::max(0.0, variance.all - (1 - jitter_share) * variance.of_jitter));
}

}  // namespace

PairPoseVariance pose_variance(const motion::Motion& steady,
                               const std::vector<motion::UncertainPose>& poses, int left, int right,
                               double lowpass_hz) {
  PairPoseVariance out;
  if (poses.size() != steady.positions.size() || poses.empty()) return out;
  const Sensitivity l = sensitivity_of(steady, poses, left, lowpass_hz),
                    r = sensitivity_of(steady, poses, right, lowpass_hz);
  out.left = variance_of(l.row, poses[l.sample]);
  out.right = variance_of(r.row, poses[r.sample]);
  out.difference = l.sample == r.sample ? variance_of(l.row - r.row, poses[l.sample])
                                        : PoseVariance{out.left.all + out.right.all,
                                                       out.left.of_jitter + out.right.of_jitter};
  return out;
}

std::map<std::string, PairPoseVariance> pose_variances(
    const motion::Motion& steady, const std::vector<motion::UncertainPose>& poses,
    double lowpass_hz) {
  std::map<std::string, PairPoseVariance> all;
  for (const PointPair& pair : point_pairs(steady))
    all[pair.name] = pose_variance(steady, poses, pair.left, pair.right, lowpass_hz);
  return all;
}

void add_pose_floors(Excursions& excursions,
                     const std::map<std::string, PairPoseVariance>& variances, double gain) {
  const auto greatest = std::ranges::max_element(
      variances, {}, [](const auto& one) { return one.second.difference.all; });
  for (PairExcursion& pair : excursions.pairs) {
    auto own = variances.find(pair.name);
    if (own == variances.end()) own = greatest;
    if (own == variances.end()) continue;
    pair.pose_floor_mm = gain * floor_mm(own->second.difference, pair.jitter_share);
    pair.left_side.pose_floor_mm = gain * floor_mm(own->second.left, pair.jitter_share);
    pair.right_side.pose_floor_mm = gain * floor_mm(own->second.right, pair.jitter_share);
    pair.judge();
  }
}

}  // namespace hyperex::metrics
