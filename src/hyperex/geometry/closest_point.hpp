// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <memory>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The point of a triangle that is closest to a given point.
struct ClosestPoint {
  int triangle = -1;          ///< row of TriMesh::triangles
  Vec3 point = Vec3::Zero();  ///< on the triangle
  Vec3 weights =
      Vec3::Zero();  ///< barycentric, each >= 0, sum 1; point = sum_k weights[k] corner_k
  double squared_distance = 0;  ///< squared length unit of the mesh
};

/// Exact closest point on the closed triangle (a, b, c): the foot of the perpendicular if it lies
/// inside, otherwise the closest point on the three edges, vertices included. (In an obtuse
/// triangle, the signs of two negative barycentric weights do not distinguish edge from vertex, so
/// they are not used for that.) Also works for slivers and for triangles collapsed to a segment or
/// a point.
ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c);

/// Closest-point queries on a triangle mesh. The tree (Embree's bounding volumes in single
/// precision, rounded outwards) is used only to exclude triangles; distances are computed in double
/// precision from the mesh itself. If several triangles have the same distance, that with the
/// lowest index is returned, independently of the tree. Queries may run in parallel. The mesh is
/// copied.
class SurfaceTree {
 public:
  /// Throws std::invalid_argument if the mesh has no triangles, if an index is out of range, or if
  /// a coordinate is not finite.
  explicit SurfaceTree(const TriMesh& mesh);
  ~SurfaceTree();
  SurfaceTree(SurfaceTree&&) noexcept;
  SurfaceTree& operator=(SurfaceTree&&) noexcept;

  /// `p` must be finite. Triangles farther away than `within` (length unit of the mesh) are
  /// ignored. If no triangle is closer, ClosestPoint::triangle is -1.
  ClosestPoint query(const Vec3& p, double within = std::numeric_limits<double>::infinity()) const;
  /// The same among the triangles f with keep[f] only. `keep` has one entry per triangle.
  ClosestPoint query_among(const std::vector<char>& keep, const Vec3& p,
                           double within = std::numeric_limits<double>::infinity()) const;
  /// A value of `within` that makes query(p) faster without changing its result. `near`: a point of
  /// the surface close to p.
  double reach(const Vec3& p, const Vec3& near) const;
  /// One result per row, computed in parallel; the same results as query().
  std::vector<ClosestPoint> query_all(const Points& points) const;
  /// The same, but faster for points that moved little since an earlier query. `near` has the
  /// earlier result for each row.
  std::vector<ClosestPoint> query_all(const Points& points,
                                      const std::vector<ClosestPoint>& near) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex
