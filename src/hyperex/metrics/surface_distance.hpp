// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// Statistics of distances. Median and 95th percentile interpolate between order statistics (type 7
/// of Hyndman and Fan). All are NaN if there is no distance.
struct DistanceStatistics {
  double mean_mm = 0, median_mm = 0, rms_mm = 0, p95_mm = 0, max_mm = 0;
  Eigen::Index count = 0;
};

/// Over all distances (m), or over those of the listed vertices.
DistanceStatistics statistics_of(const Eigen::VectorXd& distance_m);
DistanceStatistics statistics_of(const Eigen::VectorXd& distance_m,
                                 const std::vector<int>& vertices);

/// Distance (m) from each point of `a` to the closest point of the surface `b`. This is one-sided:
/// parts of `b` far from `a` have no effect. Tangential differences are underestimated. Computed in
/// parallel. Throws std::invalid_argument if b is not a valid mesh.
Eigen::VectorXd distance_to_surface(const Points& a, const TriMesh& b);

/// Distance (m) between points of equal index, for the first `count` points. Throws
/// std::invalid_argument if `a` or `b` has fewer points.
Eigen::VectorXd distance_to_corresponding(const Points& a, const Points& b, Eigen::Index count);

}  // namespace hyperex::metrics
