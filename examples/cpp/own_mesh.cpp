// SPDX-License-Identifier: GPL-3.0-or-later
// The solver without a face: a bar of tetrahedra, fixed at one end and pulled at the other.
#include <cstdio>
#include <hyperex/fem.hpp>

int main() {
  // 4 x 1 x 1 cubes of 10 mm, six tetrahedra each. Here stands a mesh of your own: nodes in metres,
  // four rising rows of nodes a tetrahedron with positive volume.
  const auto node = [](int i, int j, int k) { return (i * 2 + j) * 2 + k; };
  hyperex::Points nodes(5 * 2 * 2, 3);
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 2; ++j)
      for (int k = 0; k < 2; ++k) nodes.row(node(i, j, k)) << 0.01 * i, 0.01 * j, 0.01 * k;
  hyperex::Tetrahedra tets(4 * 6, 4);
  for (int i = 0, t = 0; i < 4; ++i) {
    const int a = node(i, 0, 0), g = node(i + 1, 1, 1);
    const int around[] = {node(i + 1, 0, 0), node(i + 1, 1, 0), node(i, 1, 0),
                          node(i, 1, 1),     node(i, 0, 1),     node(i + 1, 0, 1)};
    for (int side = 0; side < 6; ++side)
      tets.row(t++) << a, around[side], around[(side + 1) % 6], g;
  }
  const hyperex::fem::Material rubber{.young_pa = std::vector<double>(tets.rows(), 1e5),
                                      .poisson = std::vector<double>(tets.rows(), 0.45),
                                      .viscosity_pa_s = std::vector<double>(tets.rows(), 100),
                                      .density_kg_m3 = std::vector<double>(tets.rows(), 1000)};
  // Unknown 3 n + axis. At x = 0 all are fixed; at x = 40 mm the nodes are moved by 2 mm along x.
  std::vector<int> prescribed;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(8 * 3);
  for (int n = 0; n < nodes.rows(); ++n)
    if (n < 4 || n >= 16)
      for (int axis = 0; axis < 3; ++axis) prescribed.push_back(3 * n + axis);
  for (int n = 4; n < 8; ++n) values[3 * n] = 0.002;

  const hyperex::fem::System system = hyperex::fem::assemble(nodes, tets, rubber);
  const Eigen::VectorXd d = hyperex::fem::StaticSolver(system.stiffness, prescribed).solve(values);
  for (int n = 0; n < nodes.rows(); ++n)
    std::printf("node %2d: %7.3f %7.3f %7.3f mm\n", n, 1e3 * d[3 * n], 1e3 * d[3 * n + 1],
                1e3 * d[3 * n + 2]);
}
