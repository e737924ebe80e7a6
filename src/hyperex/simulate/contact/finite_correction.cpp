// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/finite_correction.hpp"

#include <algorithm>
#include <utility>

#include "hyperex/core/error.hpp"

namespace hyperex::simulate {
namespace {

fem::Hyperelastic relaxed(fem::Hyperelastic law) {
  law.branches.clear();
  return law;
}

fem::Material elastic(fem::Material material) {
  std::fill(material.viscosity_pa_s.begin(), material.viscosity_pa_s.end(), 0.0);
  return material;
}

}  // namespace

FiniteCorrection::FiniteCorrection(const fem::Assembler& assembler, const fem::Material& material,
                                   fem::Hyperelastic law, fem::SparseMatrix springs,
                                   std::vector<int> prescribed, fem::FiniteNewtonOptions how,
                                   std::shared_ptr<const fem::NodeOrder> order)
    : form_(assembler, elastic(material), relaxed(std::move(law))), springs_(springs) {
  newton_.emplace(form_, std::move(prescribed), how, std::move(springs),
                  std::vector<const fem::NodalPotential*>(), std::move(order));
}

void FiniteCorrection::begin(const Eigen::VectorXd& d0) {
  d0_ = d0;
  form_.rest_at(d0_);
  force_.resize(d0_.size());
  form_.energy_and_gradient(d0_, force_);
  if (springs_.cols() > 0) force_ += springs_ * d0_;
  prescribed_ = d0_(newton_->prescribed());
  start();
}

/// In equilibrium under what acted until then: from there further forces can come in parts.
void FiniteCorrection::start() {
  newton_->start(d0_, Eigen::VectorXd::Zero(d0_.size()), force_);
}

const Eigen::VectorXd& FiniteCorrection::under(const Eigen::VectorXd& more,
                                               const Eigen::VectorXd* guess) {
  try {
    const fem::FiniteStepReport report =
        newton_->equilibrium(prescribed_, force_ + more, {}, guess);
    iterations_ += report.iterations;
    factorisations_ += report.factorisations;
  } catch (const NumericalError&) {
    start();
    throw;
  }
  return newton_->displacement();
}

}  // namespace hyperex::simulate
