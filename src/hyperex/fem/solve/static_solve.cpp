// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/static_solve.hpp"

#include "hyperex/fem/material/entry.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"

namespace hyperex::fem {

struct StaticSolver::Impl {
  PartitionedFactor factor;
  SparseMatrix oc;
};

StaticSolver::StaticSolver(const SparseMatrix& stiffness, std::vector<int> prescribed) {
  check_matrix("the stiffness", stiffness);
  PartitionedFactor factor(stiffness, std::move(prescribed), "static solution");
  SparseMatrix oc = coupling(stiffness, factor.partition());
  impl_ = std::make_unique<Impl>(Impl{std::move(factor), std::move(oc)});
}

StaticSolver::~StaticSolver() = default;
StaticSolver::StaticSolver(StaticSolver&&) noexcept = default;

Eigen::VectorXd StaticSolver::solve(const Eigen::VectorXd& prescribed_values,
                                    const Eigen::VectorXd& force) const {
  const auto& free = impl_->factor.free();
  const auto& prescribed = impl_->factor.prescribed();
  Eigen::VectorXd all(static_cast<Eigen::Index>(free.size() + prescribed.size()));
  check_values("the prescribed displacement", prescribed_values, prescribed, "m");
  check_optional("the force", force, all.size(), "N");
  Eigen::VectorXd x = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(free.size()));
  if (force.size() > 0) x = force(free);
  x.noalias() -= impl_->oc * prescribed_values;
  impl_->factor.solve(x);
  all(free) = x;
  all(prescribed) = prescribed_values;
  return all;
}

}  // namespace hyperex::fem
