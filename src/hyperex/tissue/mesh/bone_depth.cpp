// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/bone_depth.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <queue>
#include <vector>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kSteepest = 0.5;
/// A ray may slip by the border of a bone's surface, on which the layer's end then lies.
constexpr double kOnBone_m = 3e-4;
constexpr int kBlendRounds = 12;
constexpr double kBlendShare = 0.9;

/// Reduces values that exceed that of a neighbour by more than kSteepest times the distance.
void limit_slope(const TriMesh& outer, const std::vector<std::vector<int>>& around,
                 Eigen::VectorXd& depth) {
  using Entry = std::pair<double, int>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  for (int v = 0; v < int(depth.size()); ++v) open.emplace(depth[v], v);
  while (!open.empty()) {
    const auto [value, v] = open.top();
    open.pop();
    if (value > depth[v]) continue;
    for (const int w : around[std::size_t(v)]) {
      const double most = value + kSteepest * (outer.points.row(v) - outer.points.row(w)).norm();
      if (depth[w] <= most) continue;
      depth[w] = most;
      open.emplace(most, w);
    }
  }
}

}  // namespace

Eigen::VectorXd bone_depths(const TriMesh& outer, const Points& inward,
                            const Eigen::VectorXd& without_bone, const anatomy::Bones& bones) {
  const Eigen::Index count = outer.points.rows();
  Eigen::VectorXd depth = without_bone;
  std::vector<char> over_bone(std::size_t(count), 0);
  tbb::parallel_for(Eigen::Index(0), count, [&](Eigen::Index v) {
    const Vec3 p = outer.points.row(v), way = inward.row(v).transpose().stableNormalized();
    double found = bones.along(p, way, kDeepestBone_m);
    if (!std::isfinite(found)) {
      const auto near = bones.nearest(p + without_bone[v] * way, kOnBone_m);
      if (near.bone == anatomy::Bone::none) return;
      found = without_bone[v];
    }
    depth[v] = std::max(found, kThinnestOverBone_m);
    over_bone[std::size_t(v)] = 1;
  });
  const auto around = vertex_neighbours(outer.triangles, count);
  Eigen::VectorXd more = depth - without_bone;
  for (int round = 0; round < kBlendRounds; ++round) {
    const Eigen::VectorXd before = more;
    for (Eigen::Index v = 0; v < count; ++v) {
      if (over_bone[std::size_t(v)] || around[std::size_t(v)].empty()) continue;
      double sum = 0;
      for (const int w : around[std::size_t(v)]) sum += before[w];
      more[v] = kBlendShare * sum / double(around[std::size_t(v)].size());
    }
  }
  for (Eigen::Index v = 0; v < count; ++v)
    if (!over_bone[std::size_t(v)])
      depth[v] = std::max(without_bone[v] + more[v], kThinnestOverBone_m);
  if (more.cwiseAbs().maxCoeff() > 0) limit_slope(outer, around, depth);
  return depth;
}

}  // namespace hyperex::tissue
