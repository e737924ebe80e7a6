// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The required edge length on a surface: `edge_m` at `focus`, increasing as |x - centre|^2 /
/// |focus - centre|^2.
struct GradedSize {
  double edge_m = 0.004;
  Vec3 focus = Vec3::Zero();
  Vec3 centre = Vec3::Zero();  ///< off the surface, in front of the focus
  double at(const Vec3& x) const {
    return edge_m * (x - centre).squaredNorm() / (focus - centre).squaredNorm();
  }
};

/// Covers the given surface with nearly equilateral triangles of the required size (CGAL's
/// isotropic remeshing). The graded size needs no separate algorithm: inversion in a sphere about
/// `centre` is conformal and scales lengths by 1 / |x - centre|^2, so that a uniform mesh of the
/// inverted surface is a graded mesh of the given surface. Borders are preserved and also
/// resampled. `mesh` must be manifold and oriented (clean_mesh). The same input always gives the
/// same output.
TriMesh remesh_graded(const TriMesh& mesh, const GradedSize& size, int iterations = 5);

}  // namespace hyperex
