// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// What every element kind and every material must satisfy: TEST_P(Conformance, ...) over Case.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <string>

#include "hyperex/fem/form/assembler.hpp"
#include "support/fem_support.hpp"

namespace hyperex::test {

struct Case {
  fem::ElementKind element;
  fem::ViscousForm viscous_form;
  friend void PrintTo(const Case& c, std::ostream* out) { *out << name(c); }
  static std::string name(const Case& c) {
    return std::string(c.element == fem::ElementKind::tet4 ? "tet4" : "tet4_star") +
           (c.viscous_form == fem::ViscousForm::printed ? "_printed" : "_isotropic");
  }
};

inline std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (const fem::ElementKind element : fem::kElementKinds)
    for (const auto form : {fem::ViscousForm::isotropic, fem::ViscousForm::printed})
      cases.push_back({element, form});
  return cases;
}

/// A distorted box, coarse or fine.
struct DistortedBox {
  static inline const Vec3 kSize{0.04, 0.03, 0.02};

  static BoxMesh coarse() { return box_mesh({2, 2, 2}, kSize, 0.15); }
  static BoxMesh fine() { return box_mesh({5, 4, 4}, kSize, 0.15); }
  static bool on_boundary(const Vec3& p) {
    return (p.array() < 1e-12).any() || (p.array() > kSize.array() - 1e-12).any();
  }
  static Points linear_field(const Points& nodes, const Eigen::Matrix3d& gradient) {
    return (nodes * gradient.transpose()).rowwise() + Eigen::RowVector3d(1e-3, -2e-3, 5e-4);
  }
};

/// Provides a case's element and material.
class Conformance : public testing::TestWithParam<Case>, protected DistortedBox {
 protected:
  fem::Material varied(const BoxMesh& box) const {
    fem::Material m = varied_material(box.tets.rows());
    m.viscous_form = GetParam().viscous_form;
    return m;
  }
  fem::Assembler assembler(const BoxMesh& box) const {
    return {box.nodes, box.tets, GetParam().element};
  }
  fem::System assembled(const BoxMesh& box, const fem::Material& m) const {
    fem::System system;
    assembler(box).assemble(m, system);
    return system;
  }

  /// The definition of the strain energy: mu |dev e|^2 + kappa/2 theta^2, summed over all elements.
  /// theta is averaged over the groups of the element's definition. Strains come from edges, not
  /// from B.
  double strain_energy(const BoxMesh& box, const fem::Material& m, const Points& d) const {
    const auto groups = fem::dilatation_groups(GetParam().element, box.nodes.rows(), box.tets).tets;
    double sum = 0;
    std::vector<double> theta(box.tets.rows()), volume(box.tets.rows()), bulk(box.tets.rows());
    for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
      Eigen::Matrix3d e = gradient_of(box.nodes, box.tets, t, d);
      e = (e + e.transpose()).eval() / 2;
      theta[t] = e.trace();
      volume[t] = volume_of(box.nodes, box.tets, t);
      const double young = m.young_pa[t], nu = m.poisson[t];
      bulk[t] = young / (3 * (1 - 2 * nu));
      e.diagonal().array() -= theta[t] / 3;
      sum += volume[t] * young / (2 * (1 + nu)) * e.squaredNorm();
      if (groups.size() == 0) sum += volume[t] * bulk[t] / 2 * theta[t] * theta[t];
    }
    for (int g = 0; g < groups.size(); ++g) {
      double v = 0, v_theta = 0, v_bulk = 0;
      for (const int t : groups[g]) {
        v += volume[t];
        v_theta += volume[t] * theta[t];
        v_bulk += volume[t] * bulk[t];
      }
      sum += v_bulk / 2 * (v_theta / v) * (v_theta / v);
    }
    return sum;
  }
  double dissipation(const BoxMesh& box, const fem::Material& m, const Points& v) const {
    double sum = 0;
    for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
      Eigen::Matrix3d e = gradient_of(box.nodes, box.tets, t, v);
      e = (e + e.transpose()).eval() / 2;
      e.diagonal().array() -= e.trace() / 3;
      double rate = e.squaredNorm();
      if (m.viscous_form == fem::ViscousForm::printed) rate -= e.diagonal().squaredNorm() / 2;
      sum += volume_of(box.nodes, box.tets, t) * m.viscosity_pa_s[t] * rate;
    }
    return sum;
  }
};

/// Eigenvalues relative to the largest, in rising order.
inline Eigen::VectorXd spectrum(const fem::SparseMatrix& m) {
  const Eigen::MatrixXd dense(m);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
  return values / values.tail<1>()[0];
}

/// Compares the potential's gradient by central differences (exact for quadratics, up to rounding)
/// in every unknown with matrix * x. Returns the largest error, relative to the largest entry.
inline double gradient_error(const std::function<double(const Points&)>& potential,
                             const fem::SparseMatrix& matrix, const Eigen::VectorXd& x,
                             double step) {
  const Eigen::VectorXd product = matrix * x;
  double worst = 0;
  Eigen::VectorXd moved = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    moved[i] = x[i] + step;
    const double up = potential(unflat(moved));
    moved[i] = x[i] - step;
    const double down = potential(unflat(moved));
    moved[i] = x[i];
    worst = std::max(worst, std::abs((up - down) / (2 * step) - product[i]));
  }
  return worst / product.cwiseAbs().maxCoeff();
}

}  // namespace hyperex::test
