// SPDX-License-Identifier: GPL-3.0-or-later
#include <cassert>
#include <cmath>

#include "hyperex/fem/element/tet4.hpp"
#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> element_strain(const Points& nodes,
                                                                         const Tetrahedra& tets,
                                                                         const Points& d) {
  assert(d.rows() == nodes.rows());
  Eigen::Matrix<double, Eigen::Dynamic, 6, Eigen::RowMajor> strain(tets.rows(), 6);
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    strain.row(t) =
        strain_of(make_tet4(corners_of(nodes, tets, t)), corners_of(d, tets, t)).transpose();
  return strain;
}

Eigen::VectorXd von_mises_pa(const Points& nodes, const Tetrahedra& tets, const Material& material,
                             const Points& d) {
  const auto strain = element_strain(nodes, tets, d);
  Eigen::VectorXd von_mises(tets.rows());
  for (Eigen::Index t = 0; t < tets.rows(); ++t) {
    const Eigen::Matrix<double, 6, 1> s =
        elastic_tensor(material.young_pa[t], material.poisson[t]) * strain.row(t).transpose();
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    von_mises[t] = std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * s.tail<3>().squaredNorm());
  }
  return von_mises;
}

}  // namespace hyperex::fem
