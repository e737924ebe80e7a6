// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::metrics {

/// Summary of distances. Median and 95th percentile interpolate between order statistics
/// (Hyndman and Fan's type 7). All NaN where there is none.
struct DistanceStatistics {
  double mean_mm = 0, median_mm = 0, rms_mm = 0, p95_mm = 0, max_mm = 0;
  Eigen::Index count = 0;
};

/// Over all distances (m), or over those of the listed vertices.
DistanceStatistics statistics_of(const Eigen::VectorXd& distance_m);
DistanceStatistics statistics_of(const Eigen::VectorXd& distance_m,
                                 const std::vector<int>& vertices);

/// From each point of `a` to the closest point of surface `b` (m). One-sided: what of `b` lies far
/// from `a` does not count. It flatters where a surface slides along itself. Computed in parallel.
/// Throws std::invalid_argument where b is no mesh.
Eigen::VectorXd distance_to_surface(const Points& a, const TriMesh& b);

/// Between points of the same index (m), over the first `count` of each. Throws
/// std::invalid_argument where one has fewer.
Eigen::VectorXd distance_to_corresponding(const Points& a, const Points& b, Eigen::Index count);

}  // namespace hyperex::metrics
