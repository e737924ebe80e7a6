// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include "hyperex/ct/volume.hpp"

namespace hyperex::ct {

/// The surface on which the values, interpolated between their places, are `iso_hu`: marching
/// tetrahedra (A. Doi and A. Koide, IEICE Trans. E74, 1991, 214). Each cell of eight values is cut
/// into six tetrahedra around its diagonal, in the same way everywhere. So the surface is manifold;
/// it has a border only where the volume ends and beside values that are NaN. Triangles are
/// counter-clockwise seen from where values are lower. Vertices lie on edges and diagonals of
/// the grid, where its trilinear interpolation has the value, and are shared.
/// They keep 2 % of an edge away from its ends, so that no triangle is without area.
TriMesh iso_surface(const Volume& volume, double iso_hu);

}  // namespace hyperex::ct
