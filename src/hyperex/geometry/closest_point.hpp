// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The point of a triangle nearest to some point.
struct ClosestPoint {
  int triangle = -1;          ///< row of TriMesh::triangles
  Vec3 point = Vec3::Zero();  ///< on the triangle
  Vec3 weights =
      Vec3::Zero();  ///< barycentric, each >= 0, sum 1; point = sum_k weights[k] corner_k
  double squared_distance = 0;  ///< length unit of the mesh, squared
};

/// Exact closest point on the closed triangle (a, b, c): the foot of the perpendicular where that
/// lies inside, otherwise the nearest point of the three edges, the vertices included. (The signs
/// of two negative barycentric weights do not distinguish edge from vertex in an obtuse triangle,
/// so no region is inferred from them.) Slivers and triangles collapsed to a segment or a point are
/// safe.
ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Closest-point queries on a triangle mesh. The tree (Embree's bounding volumes, in single
/// precision, rounded outwards) only rules triangles out; distances are computed in double from the
/// mesh itself. Of triangles at equal distance the one of lowest index is returned, whatever the
/// tree's shape. Queries may run in parallel. The mesh is copied.
class SurfaceTree {
 public:
  /// Throws std::invalid_argument where the mesh has no triangles, an index out of range, or a
  /// coordinate that is not finite.
  explicit SurfaceTree(const TriMesh& mesh);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  /// `p` finite. `within`: triangles farther than that (length unit of the mesh) are not looked at;
  /// ClosestPoint::triangle is -1 where there is none as near.
  ClosestPoint query(const Vec3& p, double within = std::numeric_limits<double>::infinity()) const;
  /// Of those triangles alone that `keep` holds, which has one entry per triangle.
  ClosestPoint query_among(const std::vector<char>& keep, const Vec3& p,
                           double within = std::numeric_limits<double>::infinity()) const;
  /// A `within` with which query(p) answers the same and sooner: `near` is a point of the surface.
  double reach(const Vec3& p, const Vec3& near) const;
  /// One answer a row, computed in parallel; the same numbers as query().
  std::vector<ClosestPoint> query_all(const Points& points) const;
  /// The same, found sooner where `near` has an answer for each row: for points that moved little
  /// since then.
  std::vector<ClosestPoint> query_all(const Points& points,
                                      const std::vector<ClosestPoint>& near) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex
