// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <map>
#include <utility>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The distance to a closed mesh itself, below 0 inside; exact, but not smooth where two places of
/// the surface are as near (GridDistance is). Inside and outside follow from the normal at the
/// closest point, on edges and corners by the angle-weighted one (Baerentzen and Aanaes, IEEE TVCG
/// 11, 2005, 243). Queries may run in parallel.
class MeshDistance {
 public:
  /// `closed`: watertight, triangles outward. Throws std::invalid_argument where it is empty, not
  /// finite or has a border.
  explicit MeshDistance(TriMesh closed);

  /// `within`: known to be no less than the distance's size; the search is the shorter for it.
  double at(const Vec3& place, double within = std::numeric_limits<double>::infinity()) const;
  /// False only outside of the mesh's box, where at() is above 0.
  bool may_hold(const Vec3& place) const;

 private:
  Vec3 corner(Eigen::Index triangle, int k) const;
  std::pair<int, int> edge_key(Eigen::Index triangle, int k) const;
  Vec3 normal_at(const ClosestPoint& near) const;

  TriMesh mesh_;
  SurfaceTree tree_;
  Vec3 low_, high_;
  Points of_triangle_, of_corner_;
  std::map<std::pair<int, int>, Vec3> of_edge_;
};

}  // namespace hyperex
