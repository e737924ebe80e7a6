// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/metrics/excursion.hpp"
#include "hyperex/motion/uncertain_pose.hpp"

namespace hyperex::metrics {

/// The variance of a figure by errors of the head's pose, mm^2, and the part of it that jitter of
/// the points makes.
struct PoseVariance {
  double all = 0, of_jitter = 0;
};

/// Variances of the excursion of each side and of the difference between the sides.
struct PairPoseVariance {
  PoseVariance left, right, difference;
};

/// To first order an error e of the pose (rotation, translation) changes the excursion of a point
/// at p, which goes in the direction d, by
///   d' A(p - c) e,   A: motion::pose_derivative, c: the centre of the rotation.
/// The variances follow from the covariance of e; errors of different samples are taken as
/// independent. `steady`: without head pose. `poses`: as motion::StabilisedMotion has them, one per
/// sample; 0 where there are none. Excursions are greatest in tracks filtered with the cut-off
/// `lowpass_hz` (0: as they are).
PairPoseVariance pose_variance(const motion::Motion& steady,
                               const std::vector<motion::UncertainPose>& poses, int left, int right,
                               double lowpass_hz);

/// pose_variance() of all pairs, by their names.
std::map<std::string, PairPoseVariance> pose_variances(
    const motion::Motion& steady, const std::vector<motion::UncertainPose>& poses,
    double lowpass_hz);

/// Sets the pose floors of each pair and judges it again: jitter counts as far as the filter leaves
/// it (PairExcursion::jitter_share). A pair that `variances` does not name gets the greatest of
/// them. `gain`: on all displacements.
void add_pose_floors(Excursions& excursions,
                     const std::map<std::string, PairPoseVariance>& variances, double gain = 1);

}  // namespace hyperex::metrics
