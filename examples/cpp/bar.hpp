// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <hyperex/fem.hpp>

/// A bar along x: 4 x 1 x 1 cubes of 10 mm, six tetrahedra each. Here stands a mesh of your own:
/// nodes in metres, four nodes a tetrahedron, with positive volume.
struct Bar {
  hyperex::Points nodes{5 * 2 * 2, 3};
  hyperex::Tetrahedra tets{4 * 6, 4};

  Bar() {
    const auto node = [](int i, int j, int k) { return (i * 2 + j) * 2 + k; };
    for (int i = 0; i < 5; ++i)
      for (int j = 0; j < 2; ++j)
        for (int k = 0; k < 2; ++k) nodes.row(node(i, j, k)) << 0.01 * i, 0.01 * j, 0.01 * k;
    for (int i = 0, t = 0; i < 4; ++i) {
      const int a = node(i, 0, 0), g = node(i + 1, 1, 1);
      const int around[] = {node(i + 1, 0, 0), node(i + 1, 1, 0), node(i, 1, 0),
                            node(i, 1, 1),     node(i, 0, 1),     node(i + 1, 0, 1)};
      for (int side = 0; side < 6; ++side)
        tets.row(t++) << a, around[side], around[(side + 1) % 6], g;
    }
  }
  /// A value for each tetrahedron.
  std::vector<double> all(double value) const {
    return std::vector<double>(static_cast<std::size_t>(tets.rows()), value);
  }
};
