// SPDX-License-Identifier: GPL-3.0-or-later
// Kinematics of one element, shared by the parts of FiniteStrain and inlined into their loops.
#pragma once
#include "hyperex/fem/form/finite_strain.hpp"

namespace hyperex::fem {

inline double determinant(const Eigen::Matrix3d& m) {
  return m.col(0).dot(m.col(1).cross(m.col(2)));
}

/// |X|^2 of the deviatoric part in the metric whose inverse is A, and its derivative.
inline double metric_square(const Eigen::Matrix3d& a, const Eigen::Matrix3d& x,
                            Eigen::Matrix3d& derivative) {
  const Eigen::Matrix3d ax = a * x;
  const double trace = ax.trace();
  derivative = 2 * (ax * a - trace / 3 * a);
  return ax.cwiseProduct(ax.transpose()).sum() - trace * trace / 3;
}

inline Eigen::Matrix3d FiniteStrain::gradient_at(const Eigen::VectorXd& d, Eigen::Index t) const {
  const auto& corner = mesh_.corners()[t];
  const auto& g = mesh_.shapes()[t].gradient;
  Eigen::Matrix3d f = mesh_.gradient_of_mesh(t);
  for (int a = 0; a < 4; ++a) f += d.segment<3>(3 * corner[a]) * g.row(a);
  return f;
}

inline double FiniteStrain::ratio_of(const Eigen::Matrix3d& f) const {
  return linear() ? f.trace() - 2 : determinant(f);
}
inline Eigen::Matrix3d FiniteStrain::ratio_gradient(const Eigen::Matrix3d& f) const {
  return linear() ? Eigen::Matrix3d::Identity() : cofactor(f);
}
inline Eigen::Matrix3d FiniteStrain::strain_of(const Eigen::Matrix3d& f) const {
  Eigen::Matrix3d e =
      linear() ? Eigen::Matrix3d(f + f.transpose()) : Eigen::Matrix3d(f.transpose() * f);
  e.diagonal().array() -= linear() ? 2 : 1;
  return e / 2;
}

}  // namespace hyperex::fem
