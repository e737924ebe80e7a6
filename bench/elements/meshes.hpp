// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::study {

/// What is prescribed of a node's displacement at x (each axis by itself).
using Support = std::function<std::array<std::optional<double>, 3>(const Vec3& x)>;

/// A static problem on a mesh; positions decide what is held, so that it serves elements with nodes
/// on edges too.
struct Problem {
  std::string name;
  int level = 0;  ///< cells along the problem's leading edge
  double young = 1, poisson = 0;
  Points nodes;
  Tetrahedra tets;
  Support support;
  std::vector<std::array<int, 3>> loaded;  ///< faces with traction
  std::function<Vec3(const Vec3&, const Vec3& normal)> traction;
  /// Relative error of a displacement (|nodes| x 3).
  std::function<double(const Points& d)> error;
  std::function<double(const Vec3&)> pressure;  ///< exact; empty where unknown
};

/// Cook's membrane (`cells` even): the classic plane 48 x 44 (60 on the right), held on the left,
/// sheared upwards on the right by a force of 100 per unit of depth, plane strain, E = 240.565. The
/// slab is two cells deep. Error: of the rise of the right edge's middle against `reference`.
Problem cooks_membrane(int cells, double poisson, double reference);

/// Bent beam of length 10 and height 2, plane strain, sheared parabolically at its end; its left
/// end moves as the exact solution of plane elasticity (Timoshenko and Goodier). Error: L2.
Problem bent_beam(int cells, double poisson);

/// An octant of a thick sphere (radii 1 and 2) under inner pressure 1; Lame's solution. Error: L2.
Problem inflated_sphere(int cells, double poisson);

/// A layer of 66 x 66 x 10 mm of prisms, bonded below, with a patch of 13.2 x 13.2 mm of its
/// surface displaced by (4, 0, 3) mm. `cells` along the edge (a multiple of 5), `levels` of prisms.
/// No error is set: a finer solution has to give it.
Problem pulled_layer(int cells, int levels, double poisson);

/// [0, 1]^3 with all nodes of its faces held, inner nodes moved a little from the grid,
/// numbers shuffled.
Problem unit_cube(int cells);

/// The same cube by Delaunay tetrahedra of points that are far from a grid.
Problem irregular_cube(int cells);

}  // namespace hyperex::study
