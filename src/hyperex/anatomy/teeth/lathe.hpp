// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::anatomy {

/// 0 below `from`, 1 above `to`, smooth between.
double smooth_step(double from, double to, double x);

/// sign(x) |x|^power: the corners of a superellipse.
double powered(double x, double power);

/// Rings of points, of equally many each, closed by a point at either end.
struct Lathe {
  std::vector<std::vector<Vec3>> rings;
  Vec3 first = Vec3::Zero(), last = Vec3::Zero();

  /// Closed; the normals of its triangles point all outwards or all inwards.
  TriMesh mesh() const;
};

/// Turns the triangles of a closed surface outwards.
void turn_outwards(TriMesh& mesh);

}  // namespace hyperex::anatomy
