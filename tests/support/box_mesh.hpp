// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <random>
#include <utility>
#include <vector>

#include "hyperex/geometry/types.hpp"

namespace hyperex::test {

struct BoxMesh {
  Points nodes;
  Tetrahedra tets;
  std::array<int, 3> cells{};

  int node(int i, int j, int k) const { return (k * (cells[1] + 1) + j) * (cells[0] + 1) + i; }
};

/// A box [0, size] of cells[0] x cells[1] x cells[2] cells, each cut into six tetrahedra around its
/// diagonal (conforming). `distortion` moves each inner node by up to that share of a cell, at
/// random but the same on each run; up to 0.15 keeps all volumes positive.
inline BoxMesh box_mesh(std::array<int, 3> cells, const Vec3& size, double distortion = 0,
                        unsigned seed = 1) {
  BoxMesh box;
  box.cells = cells;
  const Vec3 cell(size.x() / cells[0], size.y() / cells[1], size.z() / cells[2]);
  box.nodes.resize((cells[0] + 1) * (cells[1] + 1) * (cells[2] + 1), 3);
  std::mt19937 random(seed);
  const auto shift = [&] { return distortion * (2.0 * random() / std::mt19937::max() - 1); };
  for (int k = 0; k <= cells[2]; ++k)
    for (int j = 0; j <= cells[1]; ++j)
      for (int i = 0; i <= cells[0]; ++i) {
        Vec3 at(i, j, k);
        if (i % cells[0] && j % cells[1] && k % cells[2]) at += Vec3(shift(), shift(), shift());
        box.nodes.row(box.node(i, j, k)) = at.cwiseProduct(cell).transpose();
      }
  box.tets.resize(6 * cells[0] * cells[1] * cells[2], 4);
  // The six paths along the three axes in all orders; those of odd order are reversed to keep
  // volumes positive.
  constexpr int kPaths[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  int t = 0;
  for (int k = 0; k < cells[2]; ++k)
    for (int j = 0; j < cells[1]; ++j)
      for (int i = 0; i < cells[0]; ++i)
        for (int p = 0; p < 6; ++p, ++t) {
          std::array<int, 3> at{i, j, k};
          for (int corner = 0; corner < 4; ++corner) {
            box.tets(t, corner) = box.node(at[0], at[1], at[2]);
            if (corner < 3) ++at[kPaths[p][corner]];
          }
          if (p >= 3) std::swap(box.tets(t, 2), box.tets(t, 3));
        }
  return box;
}

}  // namespace hyperex::test
