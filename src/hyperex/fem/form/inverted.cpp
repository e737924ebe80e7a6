// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/inverted.hpp"

#include "hyperex/fem/form/mesh_entry.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

std::vector<std::uint8_t> inverted_tets(const Points& nodes, const Tetrahedra& tets,
                                        const Points& d) {
  check_corners(nodes.rows(), tets);
  check_rows("the displacement", d.rows(), nodes.rows());
  std::vector<std::uint8_t> inverted(static_cast<std::size_t>(tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    Vec3 x[4];
    for (int k = 0; k < 4; ++k) x[k] = nodes.row(tets(t, k)) + d.row(tets(t, k));
    // Written as a negation so that NaN counts as inverted.
    inverted[static_cast<std::size_t>(t)] =
        !((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) > 0);
  }
  return inverted;
}

}  // namespace hyperex::fem
