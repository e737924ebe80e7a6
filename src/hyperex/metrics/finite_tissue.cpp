// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/finite_tissue.hpp"

#include <tbb/task_arena.h>

#include <utility>

namespace hyperex::metrics {
namespace {
using simulate::Performance;

fem::Hyperelastic without_branches(fem::Hyperelastic law) {
  law.branches.clear();
  return law;
}

fem::Assembler grown(fem::Assembler mesh, const Performance& p) {
  return p.growth.empty() ? std::move(mesh) : mesh.grown(p.growth);
}

}  // namespace

void take_growth_off(const Performance& p, fem::VoigtRows& strain) {
  for (std::size_t t = 0; t < p.growth.size(); ++t) {
    const Eigen::Matrix3d& g = p.growth[t];
    auto e = strain.row(Eigen::Index(t));
    for (int k = 0; k < 3; ++k) e[k] -= g(k, k) - 1;
    e[3] -= 2 * g(0, 1);
    e[4] -= 2 * g(1, 2);
    e[5] -= 2 * g(2, 0);
  }
}

fem::Material elastic_material(const Performance& p) {
  // The values are rounded to float so that the results agree exactly with the stress written so
  // far.
  fem::Material material = p.material;
  for (std::vector<double>* values : {&material.young_pa, &material.poisson})
    for (double& value : *values) value = static_cast<float>(value);
  material.viscosity_pa_s.assign(material.young_pa.size(), 0);
  material.density_kg_m3.assign(material.young_pa.size(), 0);
  material.viscous_form = fem::ViscousForm::isotropic;
  return material;
}

FiniteTissue::FiniteTissue(const Performance& p)
    : assembler_(grown(fem::Assembler(p.nodes, p.tets, p.model.element), p)),
      form_(assembler_, elastic_material(p), without_branches(p.model.law)) {}

FiniteState FiniteTissue::at(const Points& d) const {
  const Eigen::VectorXd flat = Eigen::Map<const Eigen::VectorXd>(d.data(), d.size());
  FiniteState state;
  const std::scoped_lock lock(one_at_a_time_);
  // Isolated: otherwise a thread that holds the lock might start on another frame and wait for
  // itself.
  tbb::this_task_arena::isolate([&] {
    state.green_lagrange = form_.green_lagrange(flat);
    state.cauchy_pa = form_.cauchy_stress_pa(flat);
    state.von_mises_pa = fem::von_mises_of(state.cauchy_pa);
    state.volume_ratio = form_.volume_ratio(flat);
    state.stretch = form_.principal_stretches(flat);
  });
  return state;
}

}  // namespace hyperex::metrics
