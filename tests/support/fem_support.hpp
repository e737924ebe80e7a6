// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Shared by the finite-element tests: materials, sets of unknowns, and energies integrated without
// the element's own B matrix.
#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "support/box_mesh.hpp"

namespace hyperex::test {

inline fem::Material uniform_material(Eigen::Index tets, double young_pa, double poisson,
                                      double viscosity_pa_s, double density_kg_m3,
                                      fem::ViscousForm form = fem::ViscousForm::isotropic) {
  const auto n = static_cast<std::size_t>(tets);
  fem::Material m;
  m.young_pa.assign(n, young_pa);
  m.poisson.assign(n, poisson);
  m.viscosity_pa_s.assign(n, viscosity_pa_s);
  m.density_kg_m3.assign(n, density_kg_m3);
  m.viscous_form = form;
  return m;
}

/// Every element has other values; they are the same on each run.
inline fem::Material varied_material(Eigen::Index tets, unsigned seed = 7) {
  fem::Material m = uniform_material(tets, 1, 0, 0, 1);
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return low + (high - low) * random() / static_cast<double>(std::mt19937::max());
  };
  for (std::size_t t = 0; t < m.young_pa.size(); ++t) {
    m.young_pa[t] = between(90e3, 220e3);
    m.poisson[t] = between(0.1, 0.49);
    m.viscosity_pa_s[t] = between(300, 500);
    m.density_kg_m3[t] = between(900, 1200);
  }
  return m;
}

/// The unknowns 3 n + axis of all nodes for which `chosen(position)`.
inline std::vector<int> unknowns_where(const Points& nodes,
                                       const std::function<bool(const Vec3&)>& chosen,
                                       const std::vector<int>& axes = {0, 1, 2}) {
  std::vector<int> unknowns;
  for (Eigen::Index n = 0; n < nodes.rows(); ++n)
    if (chosen(nodes.row(n).transpose()))
      for (const int axis : axes) unknowns.push_back(static_cast<int>(3 * n) + axis);
  return unknowns;
}

inline std::vector<int> complement(Eigen::Index count, const std::vector<int>& sorted) {
  std::vector<int> rest;
  for (int i = 0; i < count; ++i)
    if (!std::binary_search(sorted.begin(), sorted.end(), i)) rest.push_back(i);
  return rest;
}

/// A |nodes| x 3 field as a vector of 3 |nodes| unknowns.
inline Eigen::VectorXd flat(const Points& field) {
  return Eigen::Map<const Eigen::VectorXd>(field.data(), field.size());
}
inline Points unflat(const Eigen::VectorXd& unknowns) {
  return Eigen::Map<const Points>(unknowns.data(), unknowns.size() / 3, 3);
}

inline Eigen::VectorXd random_vector(Eigen::Index count, unsigned seed) {
  std::mt19937 random(seed);
  Eigen::VectorXd v(count);
  for (double& x : v) x = 2.0 * random() / static_cast<double>(std::mt19937::max()) - 1;
  return v;
}

inline double volume_of(const Points& nodes, const Tetrahedra& tets, Eigen::Index t) {
  const auto at = [&](int a) -> Vec3 { return nodes.row(tets(t, a)).transpose(); };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6;
}

/// du_i/dx_j in element t, computed from its edges rather than from shape functions.
inline Eigen::Matrix3d gradient_of(const Points& nodes, const Tetrahedra& tets, Eigen::Index t,
                                   const Points& field) {
  Eigen::Matrix3d edge, difference;
  for (int k = 0; k < 3; ++k) {
    edge.col(k) = (nodes.row(tets(t, k + 1)) - nodes.row(tets(t, 0))).transpose();
    difference.col(k) = (field.row(tets(t, k + 1)) - field.row(tets(t, 0))).transpose();
  }
  return edge.transpose().partialPivLu().solve(difference.transpose()).transpose();
}

/// Integral of lambda/2 tr(e)^2 + mu e:e.
inline double strain_energy(const BoxMesh& box, const fem::Material& m, const Points& d) {
  double sum = 0;
  for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
    const Eigen::Matrix3d g = gradient_of(box.nodes, box.tets, t, d);
    const Eigen::Matrix3d e = (g + g.transpose()) / 2;
    const double young = m.young_pa[t], nu = m.poisson[t];
    const double lambda = young * nu / (1 + nu) / (1 - 2 * nu), mu = young / 2 / (1 + nu);
    sum += volume_of(box.nodes, box.tets, t) *
           (lambda / 2 * e.trace() * e.trace() + mu * e.squaredNorm());
  }
  return sum;
}

/// Half the power that Stokes' law dissipates: integral of eta dev(e'):dev(e').
inline double dissipation_potential(const BoxMesh& box, const fem::Material& m, const Points& v) {
  double sum = 0;
  for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
    const Eigen::Matrix3d g = gradient_of(box.nodes, box.tets, t, v);
    Eigen::Matrix3d e = (g + g.transpose()) / 2;
    e.diagonal().array() -= e.trace() / 3;
    sum += volume_of(box.nodes, box.tets, t) * m.viscosity_pa_s[t] * e.squaredNorm();
  }
  return sum;
}

/// Barycentric points (weight 1/4 each) of the quadrature rule that is exact for quadratics.
inline Eigen::Matrix4d quadratic_rule() {
  const double near = (5 + 3 * std::sqrt(5.0)) / 20, far = (5 - std::sqrt(5.0)) / 20;
  return Eigen::Matrix4d::Constant(far) + (near - far) * Eigen::Matrix4d::Identity();
}

/// Integral of rho/2 |v|^2.
inline double kinetic_energy(const BoxMesh& box, const fem::Material& m, const Points& v) {
  const Eigen::Matrix4d rule = quadratic_rule();
  double sum = 0;
  for (Eigen::Index t = 0; t < box.tets.rows(); ++t)
    for (int q = 0; q < 4; ++q) {
      Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
      for (int a = 0; a < 4; ++a) at += rule(q, a) * v.row(box.tets(t, a));
      sum += volume_of(box.nodes, box.tets, t) / 4 * m.density_kg_m3[t] / 2 * at.squaredNorm();
    }
  return sum;
}

}  // namespace hyperex::test
