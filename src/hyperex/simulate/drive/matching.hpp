// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::simulate {

/// The points of the tracked mesh that move a place, with their weights: the barycentric
/// coordinates of the closest point of the closest triangle at rest [4.1-4.14].
struct Match {
  std::array<int, 3> point{};
  Vec3 weight = Vec3::Zero();  ///< each >= 0, sum 1
  double distance_m = 0;
  /// d = sum_k weight_k d_k [4.15]
  template <class Rows>  ///< Points or PointsF
  Vec3 displacement(const Rows& point_displacement) const {
    const auto of = [&](int k) -> Vec3 {
      return point_displacement.row(point[k]).transpose().template cast<double>();
    };
    return weight[0] * of(0) + weight[1] * of(1) + weight[2] * of(2);
  }
};

/// One match per row of `places`. `side` (per place: -1 lower lip, 0 either, 1 upper lip) and
/// `point_side` (the same per tracked point) keep a lip from following the other one. Where both
/// are empty, distance alone decides.
std::vector<Match> match(const Points& places, const TriMesh& tracked,
                         const std::vector<int>& side = {},
                         const std::vector<int>& point_side = {});

}  // namespace hyperex::simulate
