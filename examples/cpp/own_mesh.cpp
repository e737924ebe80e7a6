// SPDX-License-Identifier: GPL-3.0-or-later
// The solver without a face: a bar of tetrahedra, fixed at one end and pulled at the other.
#include <cstdio>

#include "bar.hpp"

using namespace hyperex;

int main() {
  const Bar bar;
  const fem::Material rubber{.young_pa = bar.all(1e5),
                             .poisson = bar.all(0.45),
                             .viscosity_pa_s = bar.all(100),
                             .density_kg_m3 = bar.all(1000)};
  // Unknown 3 n + axis. At x = 0 all are fixed; at x = 40 mm the nodes are moved by 2 mm along x.
  std::vector<int> prescribed;
  Eigen::VectorXd values = Eigen::VectorXd::Zero(8 * 3);
  for (int n = 0; n < bar.nodes.rows(); ++n)
    if (n < 4 || n >= 16)
      for (int axis = 0; axis < 3; ++axis) prescribed.push_back(3 * n + axis);
  for (int n = 4; n < 8; ++n) values[3 * n] = 0.002;

  const fem::System system = fem::assemble(bar.nodes, bar.tets, rubber);
  const Eigen::VectorXd d = fem::StaticSolver(system.stiffness, prescribed).solve(values);
  for (int n = 0; n < bar.nodes.rows(); ++n)
    std::printf("node %2d: %7.3f %7.3f %7.3f mm\n", n, 1e3 * d[3 * n], 1e3 * d[3 * n + 1],
                1e3 * d[3 * n + 2]);
}
