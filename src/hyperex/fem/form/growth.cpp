// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue that grows, as by filler or an implant: it has another shape at rest.
#include <Eigen/Cholesky>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {
namespace {

void check_growth(const std::vector<Eigen::Matrix3d>& growth, Eigen::Index elements) {
  check_rows("the growth", Eigen::Index(growth.size()), elements);
  for (std::size_t t = 0; t < growth.size(); ++t)
    require(growth[t].allFinite() && growth[t].isApprox(growth[t].transpose(), 1e-9) &&
                growth[t].llt().info() == Eigen::Success,
            "the growth of tetrahedron {} is not symmetric and positive definite", t);
}

}  // namespace

Assembler Assembler::grown(const std::vector<Eigen::Matrix3d>& growth) const {
  check_growth(growth, element_count());
  Assembler out = *this;
  out.gradient_of_mesh_.resize(growth.size());
  for (std::size_t t = 0; t < growth.size(); ++t) {
    const Eigen::Matrix3d inverse = growth[t].inverse();
    out.gradient_of_mesh_[t] = gradient_of_mesh(Eigen::Index(t)) * inverse;
    out.shapes_[t].gradient = shapes_[t].gradient * inverse;
    out.shapes_[t].volume *= growth[t].determinant();
  }
  if (groups_.size() > 0) out.measure_groups();
  return out;
}

Eigen::VectorXd Assembler::growth_force(const Material& material,
                                        const std::vector<Eigen::Matrix3d>& growth) const {
  check_growth(growth, element_count());
  check_material(material, element_count());
  Eigen::VectorXd dilatation(element_count());
  for (Eigen::Index t = 0; t < element_count(); ++t)
    dilatation[t] = growth[std::size_t(t)].trace() - 3;
  const Eigen::VectorXd pressure = pressure_of(
      material, dilatation, groups_.size() > 0 ? mean_in_groups(dilatation) : Eigen::VectorXd());
  Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * node_count());
  for (Eigen::Index t = 0; t < element_count(); ++t) {
    const double shear =
        shear_modulus_pa(material.young_pa[std::size_t(t)], material.poisson[std::size_t(t)]);
    Eigen::Matrix3d stress = 2 * shear * growth[std::size_t(t)];
    stress.diagonal().array() -= stress.trace() / 3 + pressure[t];
    const Tet4& shape = shapes_[std::size_t(t)];
    for (int a = 0; a < 4; ++a)
      force.segment<3>(3 * corners_[std::size_t(t)][a]) +=
          shape.volume * stress * shape.gradient.row(a).transpose();
  }
  return force;
}

}  // namespace hyperex::fem
