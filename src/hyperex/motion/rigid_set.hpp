// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/motion/motion.hpp"

namespace hyperex::motion {

/// P points of one recording, prepared for largest_rigid_set().
struct TrackedPoints {
  std::vector<Points> positions;  ///< N samples of P x 3, m
  std::vector<double> jitter_m;   ///< of each point: standard deviation of a coordinate
  std::size_t shortest = 1;       ///< samples of the shortest mean, 0.2 s where there are enough
};

/// The points `rows` of a motion, in the samples that have all of them, two or more. Of a long
/// recording 400 to 800 evenly spaced ones are taken. A single reading off the two beside it on
/// each side is replaced by the median of the five, where a head that turns quickly does not
/// explain it. The jitter of a point is its own (jitter_of_motion()), at least the median of all
/// points. Of fewer than 20 samples it is that of jitter_of_differences(), at most 0.1 mm: there
/// jitter and motion cannot be separated.
TrackedPoints tracked_points(const Motion& motion, const std::vector<int>& rows);

/// Points that keep still against each other, and how the others move against them.
struct RigidSet {
  std::vector<Eigen::Index> points;    ///< of the P, rising
  std::vector<Eigen::Index> left_out;  ///< points that move against the set, rising
  std::vector<double> moves_m;         ///< P: farthest from the first sample, against the set
};

/// The largest set found whose points move against each other by at most `give_m` (m, > 0) and what
/// their jitter explains, in each recording of the same P points. A point is judged against the
/// pose of the set without it, over the whole recording. Its residual is averaged over windows of
/// 0.2 s, twice that and so on, up to a quarter of the recording. Let e be such a mean less the
/// mean of all samples, and C its covariance by the jitter of all points of the set. A point is
/// left out where for some window
///   max |e| > give / 2 + s sqrt(3 c(3) + 2 ln n)   or   rms |e| > sqrt((give / 4)^2 + c(d) tr C).
/// s^2 is the largest eigenvalue of C, n the number of windows, d = (n - 1) tr C / s^2, and c(d)
/// the 99.9 % point of chi-square with d degrees of freedom, divided by d (Wilson and Hilferty). C
/// is widened by the uncertainty of the estimated jitter. So the bound on the maximum follows the
/// number of samples, and a movement that lasts is found by the mean square. A set of fewer than
/// three points is that of the distances alone, and nothing is judged.
RigidSet largest_rigid_set(const std::vector<TrackedPoints>& recordings, double give_m);

}  // namespace hyperex::motion
