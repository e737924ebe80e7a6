// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <functional>

#include "hyperex/geometry/types.hpp"

namespace hyperex::test {

/// A sheet over [0, size.x] x [0, size.y], counter-clockwise seen from +z; each cell is cut in two
/// by the diagonal from its lower left to its upper right corner.
struct Sheet {
  TriMesh mesh;
  std::array<int, 2> cells{};
  int vertex(int i, int j) const { return j * (cells[0] + 1) + i; }
};

inline Sheet sheet_mesh(
    std::array<int, 2> cells, const Eigen::Vector2d& size,
    const std::function<double(double, double)>& height = [](double, double) { return 0.0; }) {
  Sheet sheet;
  sheet.cells = cells;
  sheet.mesh.points.resize((cells[0] + 1) * (cells[1] + 1), 3);
  for (int j = 0; j <= cells[1]; ++j)
    for (int i = 0; i <= cells[0]; ++i) {
      const double x = size.x() * i / cells[0], y = size.y() * j / cells[1];
      sheet.mesh.points.row(sheet.vertex(i, j)) << x, y, height(x, y);
    }
  sheet.mesh.triangles.resize(2 * cells[0] * cells[1], 3);
  Eigen::Index f = 0;
  for (int j = 0; j < cells[1]; ++j)
    for (int i = 0; i < cells[0]; ++i) {
      const int a = sheet.vertex(i, j), b = sheet.vertex(i + 1, j), c = sheet.vertex(i + 1, j + 1),
                d = sheet.vertex(i, j + 1);
      sheet.mesh.triangles.row(f++) << a, b, c;
      sheet.mesh.triangles.row(f++) << a, c, d;
    }
  return sheet;
}

}  // namespace hyperex::test
