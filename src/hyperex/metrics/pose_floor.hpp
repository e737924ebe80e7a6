// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "hyperex/metrics/excursion.hpp"
#include "hyperex/motion/uncertain_pose.hpp"

namespace hyperex::metrics {

/// How far an error of the head's pose may part the excursions of two points, 95 %, mm. To first
/// order an error e of the pose (rotation, translation) changes the excursion of a point at p,
/// which goes in the direction d, by
///   d' A(p - c) e,   A: motion::pose_derivative, c: the centre of the rotation.
/// The variance of the difference between both sides follows from the covariance of e, less what
/// filtering takes of jitter's part; errors of different samples are taken as independent.
/// `steady`: without head pose. `poses`: as motion::StabilisedMotion has them, one per sample; 0
/// where there are none. `lowpass_hz`: cut-off with which excursions are filtered; 0: they are not.
double excursion_pose_floor_mm(const motion::Motion& steady,
                               const std::vector<motion::UncertainPose>& poses, int left, int right,
                               double lowpass_hz);

/// The floors of all pairs by their names.
std::map<std::string, double> pose_floors_mm(const motion::Motion& steady,
                                             const std::vector<motion::UncertainPose>& poses,
                                             double lowpass_hz);

/// Sets pose_floor_mm of each pair and judges it again. A pair that `floors_mm` does not name gets
/// the greatest of them.
void add_pose_floors(Excursions& excursions, const std::map<std::string, double>& floors_mm);

}  // namespace hyperex::metrics
