// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace hyperex {

using Vec3 = Eigen::Vector3d;
/// |V| x 3, metres unless its name says otherwise; row-major, so that .data() is x0 y0 z0 x1 ...
using Points = Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// |V| x 3 in single precision, for displacements of many frames.
using PointsF = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// |F| x 3 vertex indices, counter-clockwise seen from outside.
using Triangles = Eigen::Matrix<int, Eigen::Dynamic, 3, Eigen::RowMajor>;
/// |T| x 4 node indices, positive volume: det[b-a, c-a, d-a] > 0.
using Tetrahedra = Eigen::Matrix<int, Eigen::Dynamic, 4, Eigen::RowMajor>;

/// A triangle mesh; metres inside the program.
struct TriMesh {
  Points points;
  Triangles triangles;
};

}  // namespace hyperex
