// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/finite_strain.hpp"

#include <algorithm>
#include <limits>

#include "hyperex/fem/form/finite_kinematics.hpp"
#include "hyperex/fem/form/for_each_index.hpp"
#include "hyperex/fem/material/entry.hpp"

namespace hyperex::fem {

using Eigen::Matrix3d;

FiniteStrain::FiniteStrain(const Assembler& mesh, const Material& material, const Hyperelastic& law)
    : mesh_(mesh), law_(law) {
  check_law(law);
  const auto elements = static_cast<std::size_t>(mesh.element_count());
  mass_.resize(mesh.mass_neighbours().item.size());
  step_.resize(elements);
  law_stress_.resize(elements);
  branch_.assign(law.branches.size(), std::vector<Matrix3d>(elements));
  fade_.resize(law.branches.size());
  share_.resize(law.branches.size());
  f_.resize(elements);
  piola_.resize(elements);
  ratio_.resize(elements);
  element_energy_.resize(elements);
  pressure_.assign(elements, 0);
  blocks_.resize(54 * elements);

  const Lists &groups = mesh.groups(), &nodes = mesh.group_nodes();
  group_ratio_.resize(groups.size());
  group_gradient_.resize(nodes.item.size());
  group_places_.resize(groups.item.size());
  for_each_index(groups.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    for (int k = groups.start[g]; k < groups.start[g + 1]; ++k)
      for (int a = 0; a < 4; ++a)
        group_places_[k][a] =
            static_cast<int>(std::lower_bound(nodes.item.begin() + nodes.start[g],
                                              nodes.item.begin() + nodes.start[g + 1],
                                              mesh.corners()[groups.item[k]][a]) -
                             nodes.item.begin());
  });
  set_material(material);
}

void FiniteStrain::set_material(const Material& material) {
  require(material.viscous_form == ViscousForm::isotropic,
          "Material::viscous_form is printed: expected isotropic, which finite strain needs");
  check_material(material, mesh_.element_count());
  const auto count = static_cast<std::size_t>(mesh_.element_count());
  moduli_ = mesh_.moduli(material);
  group_stiffness_ = mesh_.group_stiffness(moduli_);
  energy_rounding_ = 0;
  for (std::size_t t = 0; t < count; ++t)
    energy_rounding_ +=
        std::numeric_limits<double>::epsilon() * moduli_[t].shear * mesh_.shapes()[t].volume;
  viscosity_ = material.viscosity_pa_s;
  viscous_ = std::any_of(viscosity_.begin(), viscosity_.end(), [](double eta) { return eta > 0; });
  std::fill(mass_.begin(), mass_.end(), 0.0);
  element_mass_.resize(count);
  for (std::size_t t = 0; t < count; ++t)
    element_mass_[t] = mass_entry(mesh_.shapes()[t], material.density_kg_m3[t], 0, 1);
  for_each_index(mesh_.node_count(), [&](Eigen::Index at) {
    const int n = static_cast<int>(at);
    const Lists& around = mesh_.tets_around();
    double* const row = mass_.data() + mesh_.mass_neighbours().start[n];
    for (int k = around.start[n]; k < around.start[n + 1]; ++k) {
      const int t = around.item[k];
      for (int a = 0; a < 4; ++a)
        row[mesh_.mass_slots()[k][a]] += element_mass_[t] * (mesh_.corners()[t][a] == n ? 2 : 1);
    }
  });
  rest_at(Eigen::VectorXd::Zero(3 * mesh_.node_count()));
}

void FiniteStrain::find_kinematics(const Eigen::VectorXd& d) {
  check_size("the displacement", d.size(), 3 * mesh_.node_count());
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    f_[t] = gradient_at(d, t);
    ratio_[t] = ratio_of(f_[t]);
  });
  const Lists& groups = mesh_.groups();
  if (groups.size() == 0) return;
  for_each_index(groups.size(), [&](Eigen::Index at) {
    const int g = static_cast<int>(at);
    double sum = 0;
    for (const int t : groups[g])
      sum += mesh_.shapes()[t].volume / static_cast<double>(mesh_.groups_of()[t].size()) *
             (ratio_[t] - 1);
    group_ratio_[g] = sum / mesh_.group_volume()[g];
  });
  for_each_index(mesh_.element_count(), [&](Eigen::Index at) {
    const int t = static_cast<int>(at);
    const auto of = mesh_.groups_of()[t];
    double sum = 0;
    for (const int g : of) sum += group_stiffness_[g] / mesh_.group_volume()[g] * group_ratio_[g];
    pressure_[t] = sum / static_cast<double>(of.size());
  });
}

double FiniteStrain::evaluate(const Eigen::VectorXd& d, bool step, Eigen::VectorXd* gradient) {
  find_kinematics(d);
  const bool rates = step && has_rates();
  const double share = step ? 1 + branch_share_ : 1;
  for_each_index(mesh_.element_count(), [&](Eigen::Index t) {
    const Matrix3d& f = f_[t];
    const double shear = moduli_[t].shear, kept = moduli_[t].kept(), j = ratio_[t];
    double energy = kept / 2 * (j - 1) * (j - 1), by_ratio = kept * (j - 1) + pressure_[t];
    Matrix3d& p = piola_[t];
    if (linear()) {
      Matrix3d e = (f + f.transpose()) / 2;
      e.diagonal().array() -= e.trace() / 3;
      energy += share * shear * e.squaredNorm();
      p = 2 * share * shear * e;
      p.diagonal().array() += by_ratio;
    } else {
      const Matrix3d cof = cofactor(f);
      const double i1 = f.squaredNorm();
      const LawResponse r = respond(law_, shear, i1, cof.squaredNorm(), j);
      energy += share * r.w;
      by_ratio += share * r.dj;
      if (law_.barrier) {
        const OfRatio barrier = volume_barrier(j);
        energy += shear * barrier.w;
        by_ratio += shear * barrier.d;
      }
      p = 2 * share * r.d1 * f + by_ratio * cof;
      if (r.d2 != 0) p += 2 * share * r.d2 * (i1 * f - f * (f.transpose() * f));
    }
    if (rates) {
      const Matrix3d e = strain_of(f);
      Matrix3d s;
      energy += step_[t].viscosity / 2 * metric_square(step_[t].metric, e - step_[t].strain, s);
      s *= step_[t].viscosity / 2;
      s += step_[t].stress;
      energy += step_[t].stress.cwiseProduct(e).sum();
      p += linear() ? s : Matrix3d(f * s);
    }
    element_energy_[t] = mesh_.shapes()[t].volume * energy;
    p *= mesh_.shapes()[t].volume;
  });
  double sum = 0;
  for (const double e : element_energy_) sum += e;
  for (std::size_t g = 0; g < group_ratio_.size(); ++g)
    sum += group_stiffness_[g] / 2 * group_ratio_[g] * group_ratio_[g];
  if (gradient) {
    gradient->resize(d.size());
    for_each_index(mesh_.node_count(), [&](Eigen::Index at) {
      const int n = static_cast<int>(at);
      Vec3 f = Vec3::Zero();
      for (const int t : mesh_.tets_around()[n]) {
        int a = 0;
        while (mesh_.corners()[t][a] != n) ++a;
        f += piola_[t] * mesh_.shapes()[t].gradient.row(a).transpose();
      }
      gradient->segment<3>(3 * at) = f;
    });
  }
  return sum;
}

double FiniteStrain::energy_and_gradient(const Eigen::VectorXd& d, Eigen::VectorXd& gradient) {
  return evaluate(d, true, &gradient);
}
double FiniteStrain::energy(const Eigen::VectorXd& d) {
  return evaluate(d, true, nullptr);
}
double FiniteStrain::elastic_energy(const Eigen::VectorXd& d) {
  return evaluate(d, false, nullptr);
}

void FiniteStrain::mass_product(const Eigen::VectorXd& u, Eigen::VectorXd& out) const {
  check_size("the vector", u.size(), 3 * mesh_.node_count());
  const Lists& neighbours = mesh_.mass_neighbours();
  out.resize(u.size());
  for_each_index(mesh_.node_count(), [&](Eigen::Index n) {
    Vec3 sum = Vec3::Zero();
    for (int k = neighbours.start[n]; k < neighbours.start[n + 1]; ++k)
      sum += mass_[k] * u.segment<3>(3 * neighbours.item[k]);
    out.segment<3>(3 * n) = sum;
  });
}

}  // namespace hyperex::fem
