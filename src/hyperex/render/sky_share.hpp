// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/geometry/types.hpp"

namespace hyperex::render {

/// Ambient occlusion: the share (0 to 1) of the light from all directions that reaches each place.
/// This is the share of the directions in front of it, weighted by their cosine with its normal, in
/// which no part of `mesh` lies within `far_m`. 48 rays per place. 1 if a normal is 0. Places and
/// normals: n x 3.
Eigen::VectorXf sky_share(const TriMesh& mesh, const Points& places, const Points& normals,
                          double far_m = 0.05);

/// The same for the vertices of the mesh, on the side of their normals.
Eigen::VectorXf sky_share(const TriMesh& mesh, double far_m = 0.05);

}  // namespace hyperex::render
