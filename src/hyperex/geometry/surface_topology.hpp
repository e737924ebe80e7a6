// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// Closed walks of vertices along border edges (edges of one triangle only), each in the direction
/// of its triangles. A vertex where two borders touch appears once in each.
std::vector<std::vector<int>> boundary_loops(const Triangles& triangles);

/// Of such a walk, back to where it began.
double loop_length(const std::vector<int>& loop, const Points& points);

/// Neighbours of every vertex along edges, sorted.
std::vector<std::vector<int>> vertex_neighbours(const Triangles& triangles, Eigen::Index vertices);

/// Triangles around every vertex, in rising order.
std::vector<std::vector<int>> vertex_triangles(const Triangles& triangles, Eigen::Index vertices);

/// Number of the edge-connected component of each triangle; components are numbered in the order of
/// their first triangle.
std::vector<int> triangle_components(const Triangles& triangles, Eigen::Index vertices);

/// Area-weighted unit normals of the vertices; zero where a vertex has no area around it.
Points vertex_normals(const TriMesh& mesh);

/// Per triangle: one of its vertices is flagged.
std::vector<char> touching(const Triangles& triangles, const std::vector<char>& flagged_vertices);

/// |F| areas, m^2.
Eigen::VectorXd triangle_areas(const TriMesh& mesh);

}  // namespace hyperex
