// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Sparse>
#include <memory>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/tissue/mesh/side_tree.hpp"

namespace hyperex::tissue {

/// A smooth field on a surface through values at points: the minimum of
///   integral k |grad u|^2,  k(x) = max(1, (r / d(x))^2),
/// where d is the distance to the nearest point and r = 6 mm; natural boundary condition at
/// borders. Farther than r from all points, u is harmonic. The weight k makes the problem well
/// posed: a point has no capacity in two dimensions, so without k the field would tend to a
/// constant with spikes at the points as the mesh is refined. With k, u - u(point) grows as d^2
/// near a point, without a kink. Linear finite elements; an edge's weight (k_1 cot a_1 + k_2 cot
/// a_2) / 2 is kept at or above 0.1 % of the mean of k_1 and k_2, so that the matrix is an M-matrix
/// and u lies between the least and the greatest value (discrete maximum principle; M. Wardetzky et
/// al., "Discrete Laplace operators: no free lunch", SGP 2007). On Delaunay meshes hardly any edge
/// is clamped. The corners of the triangle under a point take the point's value, so that the field
/// meets it.
class HarmonicField {
 public:
  /// `same`: per vertex, the lowest vertex at the same place on the same side (joined_vertices).
  /// `at`: the points' places on `mesh`, one or more.
  HarmonicField(const TriMesh& mesh, const std::vector<int>& same,
                const std::vector<PlaceOnMesh>& at);
  ~HarmonicField();

  /// Maps one value per point to one value per vertex. If two points share a corner, the value of
  /// the first one is used there (see shared_corner). A connected part of the surface without a
  /// point takes the value of the vertex nearest to it.
  Eigen::VectorXd solve(const Eigen::VectorXd& values) const;

  /// Two points whose triangles share a corner; {-1, -1} where there are none.
  std::array<int, 2> shared_corner() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Joins vertices at the same place, except those of different lips, whose rims may touch at rest.
/// Returns for each vertex the lowest vertex that it is joined with.
std::vector<int> joined_vertices(const Points& points, const std::vector<double>& upper_margin);

}  // namespace hyperex::tissue
