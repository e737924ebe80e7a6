// SPDX-License-Identifier: GPL-3.0-or-later
#include <tbb/parallel_for.h>

#include <cmath>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/form/mesh_entry.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

Eigen::Matrix<double, 4, 3> Assembler::corner_values(const Points& d, Eigen::Index t) const {
  Eigen::Matrix<double, 4, 3> values;
  for (int a = 0; a < 4; ++a) values.row(a) = d.row(corners_[t][a]);
  return values;
}

VoigtRows Assembler::strain(const Points& d) const {
  check_rows("the displacement", d.rows(), node_count());
  VoigtRows strain(element_count(), 6);
  tbb::parallel_for(Eigen::Index{0}, element_count(), [&](Eigen::Index t) {
    strain.row(t) = strain_of(shapes_[t].gradient, corner_values(d, t)).transpose();
  });
  return strain;
}

Eigen::VectorXd Assembler::group_dilatation(const Points& d) const {
  Eigen::VectorXd theta(groups_.size());
  tbb::parallel_for(0, groups_.size(), [&](int g) {
    theta[g] = 0;
    for (int k = group_nodes_.start[g]; k < group_nodes_.start[g + 1]; ++k)
      theta[g] += d.row(group_nodes_.item[k]).dot(group_gradient_[k]);
  });
  return theta;
}

/// For each group, the mean over its elements, by their volumes.
Eigen::VectorXd Assembler::mean_in_groups(const Eigen::VectorXd& of_element) const {
  Eigen::VectorXd mean = Eigen::VectorXd::Zero(groups_.size());
  for (int g = 0; g < groups_.size(); ++g) {
    for (const int t : groups_[g])
      mean[g] += shapes_[t].volume / static_cast<double>(groups_of_[t].size()) * of_element[t];
    mean[g] /= group_volume_[g];
  }
  return mean;
}

/// For each element, the mean over its groups.
Eigen::VectorXd Assembler::spread(const Eigen::VectorXd& of_group) const {
  Eigen::VectorXd of_element(element_count());
  tbb::parallel_for(0, static_cast<int>(element_count()), [&](int t) {
    of_element[t] = 0;
    for (const int g : groups_of_[t]) of_element[t] += of_group[g];
    of_element[t] /= static_cast<double>(groups_of_[t].size());
  });
  return of_element;
}

Eigen::VectorXd Assembler::own_dilatation(const Points& d) const {
  Eigen::VectorXd theta(element_count());
  tbb::parallel_for(Eigen::Index{0}, element_count(), [&](Eigen::Index t) {
    theta[t] = shapes_[t].gradient.cwiseProduct(corner_values(d, t)).sum();
  });
  return theta;
}

Eigen::VectorXd Assembler::dilatation(const Points& d) const {
  check_rows("the displacement", d.rows(), node_count());
  return groups_.size() > 0 ? spread(group_dilatation(d)) : own_dilatation(d);
}

Eigen::VectorXd Assembler::pressure_pa(const Material& material, const Points& d) const {
  check_rows("the displacement", d.rows(), node_count());
  check_material(material, element_count());
  return pressure_of(material, own_dilatation(d), group_dilatation(d));
}

/// `own`: dilatation per element; `of_group`: its mean in each group.
Eigen::VectorXd Assembler::pressure_of(const Material& material, Eigen::VectorXd own,
                                       Eigen::VectorXd of_group) const {
  const std::vector<Moduli> of_element = moduli(material);
  Eigen::VectorXd pressure = std::move(own);
  for (Eigen::Index t = 0; t < pressure.size(); ++t) pressure[t] *= -of_element[t].kept();
  if (groups_.size() == 0) return pressure;
  const std::vector<double> stiffness = group_stiffness(of_element);
  for (int g = 0; g < groups_.size(); ++g)
    of_group[g] = group_volume_[g] > 0 ? stiffness[g] / group_volume_[g] * of_group[g] : 0;
  return pressure - spread(of_group);
}

VoigtRows Assembler::stress_pa(const Material& material, const Points& d) const {
  const Eigen::VectorXd pressure = pressure_pa(material, d);
  VoigtRows stress = strain(d);
  tbb::parallel_for(Eigen::Index{0}, element_count(), [&](Eigen::Index t) {
    const double shear = shear_modulus_pa(material.young_pa[t], material.poisson[t]);
    auto s = stress.row(t);
    s.head<3>().array() -= s.head<3>().mean();
    s.head<3>() *= 2;
    s *= shear;
    s.head<3>().array() -= pressure[t];
  });
  return stress;
}

namespace {

/// Computed from the strain, so that the pressure, which may be thousands of times larger, does not
/// enter.
double von_mises_of(const Eigen::Matrix<double, 1, 6>& strain, double shear) {
  const double xy = strain[0] - strain[1], yz = strain[1] - strain[2], zx = strain[2] - strain[0];
  return shear * std::sqrt(2 * (xy * xy + yz * yz + zx * zx) + 3 * strain.tail<3>().squaredNorm());
}

}  // namespace

Eigen::VectorXd Assembler::von_mises_pa(const Material& material, const Points& d) const {
  return fem::von_mises_pa(strain(d), material);
}

System assemble(const Points& nodes, const Tetrahedra& tets, const Material& material,
                ElementKind kind) {
  System system;
  Assembler(nodes, tets, kind).assemble(material, system);
  return system;
}

ElementStrain::ElementStrain(const Points& nodes, const Tetrahedra& tets)
    : nodes_(nodes.rows()), tets_(tets) {
  check_corners(nodes_, tets);
  gradient_.reserve(static_cast<std::size_t>(tets.rows()));
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    gradient_.push_back(make_tet4(corners_of(nodes, tets, t)).gradient);
}

VoigtRows ElementStrain::at(const Points& d) const {
  check_rows("the displacement", d.rows(), nodes_);
  VoigtRows strain(tets_.rows(), 6);
  for (Eigen::Index t = 0; t < tets_.rows(); ++t)
    strain.row(t) =
        strain_of(gradient_[static_cast<std::size_t>(t)], corners_of(d, tets_, t)).transpose();
  return strain;
}

Eigen::VectorXd von_mises_pa(const VoigtRows& strain, const Material& material) {
  check_material(material, strain.rows());
  Eigen::VectorXd out(strain.rows());
  for (Eigen::Index t = 0; t < out.size(); ++t)
    out[t] =
        von_mises_of(strain.row(t), shear_modulus_pa(material.young_pa[t], material.poisson[t]));
  return out;
}

}  // namespace hyperex::fem
