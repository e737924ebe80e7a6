// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Edge length over a surface: `edge_m` at `focus`, growing as |x - centre|^2 / |focus - centre|^2.
struct GradedSize {
  double edge_m = 0.004;
  Vec3 focus = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< off the surface, in front of the focus
  double at(const Vec3& x) const {
    return edge_m * (x - centre).squaredNorm() / (focus - centre).squaredNorm();
  }
};

/// Nearly equilateral triangles of the wanted size on the given surface (CGAL's isotropic
/// remeshing). The grading costs no second algorithm: inversion in a sphere about `centre` is
/// conformal and scales lengths by 1 / |x - centre|^2, so a uniform mesh of the inverted surface is
/// a graded mesh of the given one. Borders stay borders and are resampled too.
/// `mesh` must be manifold and oriented (clean_mesh). The same input gives the same output.
TriMesh remesh_graded(const TriMesh& mesh, const GradedSize& size, int iterations = 5);

}  // namespace hyperex
