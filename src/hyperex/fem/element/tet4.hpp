// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <Eigen/Dense>

#include "hyperex/fem/material/linear_viscoelastic.hpp"
#include "hyperex/geometry/types.hpp"

namespace hyperex::fem {

/// Linear tetrahedron: N_a(x) = N_a(0) + gradient.row(a) . x, constant strain.
struct Tet4 {
  Eigen::Matrix<double, 4, 3> gradient;  ///< dN_a / dx_k, 1/m
  double volume = 0;                     ///< m^3, signed: det[b-a, c-a, d-a] / 6
};

/// `corner`: 4 x 3, m. If the volume is not positive, the gradients are meaningless.
inline Tet4 make_tet4(const Eigen::Matrix<double, 4, 3>& corner) {
  // Rows of the inverse of the edge matrix are the gradients of N_1..N_3; the four sum to zero.
  Eigen::Matrix3d edge;
  for (int k = 0; k < 3; ++k) edge.col(k) = (corner.row(k + 1) - corner.row(0)).transpose();
  Tet4 tet;
  tet.volume = edge.determinant() / 6;
  tet.gradient.bottomRows<3>() = edge.inverse();
  tet.gradient.row(0) = -tet.gradient.bottomRows<3>().colwise().sum();
  return tet;
}

/// The corners of tetrahedron `t`, 4 x 3.
inline Eigen::Matrix<double, 4, 3> corners_of(const Points& nodes, const Tetrahedra& tets,
                                              Eigen::Index t) {
  Eigen::Matrix<double, 4, 3> corner;
  for (int a = 0; a < 4; ++a) corner.row(a) = nodes.row(tets(t, a));
  return corner;
}

/// B_a (6 x 3): strain (e_x, e_y, e_z, g_xy, g_yz, g_zx) = sum_a B_a d_a  [3.25].
inline Eigen::Matrix<double, 6, 3> strain_displacement(const Eigen::RowVector3d& g) {
  Eigen::Matrix<double, 6, 3> b;
  b << g.x(), 0, 0,     //
      0, g.y(), 0,      //
      0, 0, g.z(),      //
      g.y(), g.x(), 0,  //
      0, g.z(), g.y(),  //
      g.z(), 0, g.x();
  return b;
}

/// Strain of the displacements `d` of the four corners (4 x 3): sum_a B_a d_a without the zeros of
/// B.
inline Eigen::Matrix<double, 6, 1> strain_of(const Eigen::Matrix<double, 4, 3>& gradient,
                                             const Eigen::Matrix<double, 4, 3>& d) {
  Eigen::Matrix<double, 6, 1> strain = Eigen::Matrix<double, 6, 1>::Zero();
  for (int a = 0; a < 4; ++a) {
    const auto g = gradient.row(a), u = d.row(a);
    strain[0] += g.x() * u.x();
    strain[1] += g.y() * u.y();
    strain[2] += g.z() * u.z();
    strain[3] += g.y() * u.x() + g.x() * u.y();
    strain[4] += g.z() * u.y() + g.y() * u.z();
    strain[5] += g.z() * u.x() + g.x() * u.z();
  }
  return strain;
}

/// Entry (a, b) of the consistent mass, the same on each axis: rho * integral N_a N_b dV
/// = rho V / 20 (1 + delta_ab)  [4.24].
inline double mass_entry(const Tet4& tet, double density_kg_m3, int a, int b) {
  return density_kg_m3 * tet.volume / 20 * (a == b ? 2 : 1);
}

}  // namespace hyperex::fem
