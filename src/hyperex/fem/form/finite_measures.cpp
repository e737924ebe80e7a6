// SPDX-License-Identifier: GPL-3.0-or-later
// Quantities derived from a state at finite strain: strains, stresses, stretches.
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "hyperex/fem/form/finite_kinematics.hpp"
#include "hyperex/fem/form/for_each_index.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

using Eigen::Matrix3d;

std::vector<Matrix3d> FiniteStrain::deformation_gradient(const Eigen::VectorXd& d) const {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  std::vector<Matrix3d> f(static_cast<std::size_t>(mesh_.element_count()));
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) { f[t] = gradient_at(d, t); });
  return f;
}

Eigen::VectorXd FiniteStrain::volume_ratio(const Eigen::VectorXd& d) const {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  Eigen::VectorXd ratio(mesh_.element_count());
  for_each_index(ratio.size(), [&](Eigen::Index t) { ratio[t] = determinant(gradient_at(d, t)); });
  return ratio;
}

namespace {

void set_voigt(const Matrix3d& m, double shear, Eigen::Index row, VoigtRows& out) {
  out.row(row) << m(0, 0), m(1, 1), m(2, 2), shear * m(0, 1), shear * m(1, 2), shear * m(2, 0);
}

}  // namespace

VoigtRows FiniteStrain::green_lagrange(const Eigen::VectorXd& d) const {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  VoigtRows strain(mesh_.element_count(), 6);
  for_each_index(strain.rows(), [&](Eigen::Index t) {
    const Matrix3d f = gradient_at(d, t);
    set_voigt((f.transpose() * f - Matrix3d::Identity()) / 2, 2, t, strain);
  });
  return strain;
}

VoigtRows FiniteStrain::cauchy_stress_pa(const Eigen::VectorXd& d) {
  evaluate(d, false, nullptr);
  VoigtRows stress(mesh_.element_count(), 6);
  for_each_index(stress.rows(), [&](Eigen::Index t) {
    const double j = determinant(f_[t]);
    if (!(j > 0)) {
      stress.row(t).setConstant(std::numeric_limits<double>::quiet_NaN());
      return;
    }
    const Matrix3d p = piola_[t] / mesh_.shapes()[t].volume;
    set_voigt(linear() ? p : Matrix3d(p * f_[t].transpose() / j), 1, t, stress);
  });
  return stress;
}

Eigen::VectorXd von_mises_of(const VoigtRows& stress) {
  Eigen::VectorXd out(stress.rows());
  for_each_index(out.size(), [&](Eigen::Index t) {
    const auto s = stress.row(t);
    const double xy = s[0] - s[1], yz = s[1] - s[2], zx = s[2] - s[0];
    out[t] = std::sqrt((xy * xy + yz * yz + zx * zx) / 2 + 3 * s.tail<3>().squaredNorm());
  });
  return out;
}

Points FiniteStrain::principal_stretches(const Eigen::VectorXd& d) const {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  Points stretch(mesh_.element_count(), 3);
  for_each_index(stretch.rows(), [&](Eigen::Index t) {
    const Matrix3d f = gradient_at(d, t);
    const Eigen::SelfAdjointEigenSolver<Matrix3d> eigen(f.transpose() * f, Eigen::EigenvaluesOnly);
    stretch.row(t) = eigen.eigenvalues().cwiseMax(0).cwiseSqrt().transpose();
  });
  return stretch;
}

}  // namespace hyperex::fem
