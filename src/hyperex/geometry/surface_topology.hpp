// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The borders of a surface as closed loops of vertices along border edges (edges with one triangle
/// only). Each loop runs in the direction of its triangles. A vertex at which two borders meet
/// appears once in each.
std::vector<std::vector<int>> boundary_loops(const Triangles& triangles);

/// Length of such a closed loop.
double loop_length(const std::vector<int>& loop, const Points& points);

/// For each vertex, the vertices joined to it by an edge, sorted.
std::vector<std::vector<int>> vertex_neighbours(const Triangles& triangles, Eigen::Index vertices);

/// For each vertex, the triangles around it, increasing.
std::vector<std::vector<int>> vertex_triangles(const Triangles& triangles, Eigen::Index vertices);

/// For each triangle, the number of its edge-connected component. Components are numbered in the
/// order of their first triangle.
std::vector<int> triangle_components(const Triangles& triangles, Eigen::Index vertices);

/// Area-weighted unit normals of the vertices; zero if the triangles around a vertex have no area.
Points vertex_normals(const TriMesh& mesh);

/// For each triangle, whether at least one of its vertices is flagged.
std::vector<char> touching(const Triangles& triangles, const std::vector<char>& flagged_vertices);

/// Area of each triangle, m^2.
Eigen::VectorXd triangle_areas(const TriMesh& mesh);

}  // namespace hyperex
