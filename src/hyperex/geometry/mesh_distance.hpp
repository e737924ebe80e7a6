// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <map>
#include <utility>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The exact signed distance to a closed mesh, negative inside. It is not smooth where several
/// places of the surface are equally close (GridDistance is smooth). The sign follows from the
/// normal at the closest point; on edges and vertices, this is the angle-weighted normal
/// (Baerentzen and Aanaes, IEEE TVCG 11, 2005, 243). Queries may run in parallel.
class MeshDistance {
 public:
  /// `closed`: watertight, triangles outward. Throws std::invalid_argument where it is empty, not
  /// finite or has a border.
  explicit MeshDistance(TriMesh closed);

  /// `within`: a known upper bound of the magnitude of the distance; it shortens the search.
  double at(const Vec3& place, double within = std::numeric_limits<double>::infinity()) const;
  /// False only outside the bounding box of the mesh, where at() is positive.
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
