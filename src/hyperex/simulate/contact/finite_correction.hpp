// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/time/finite_newton.hpp"

namespace hyperex::simulate {

/// Tissue at finite strain that further forces act on, in a moment of its motion. All that acted
/// until then, inertia and viscosity with it, is kept as it is: with f(d) the elastic forces and
/// the springs at displacement d, the answer to `more` at the moment's displacement d0 is the d
/// where f(d) = f(d0) + more on what is free. Branches count as relaxed. One moment at a time.
class FiniteCorrection {
 public:
  /// `springs`: on the pattern of System::stiffness, no columns: none; `prescribed`: what stays
  /// where d0 has it; `order`: FiniteNewton. `assembler` must outlive this.
  FiniteCorrection(const fem::Assembler& assembler, const fem::Material& material,
                   fem::Hyperelastic law, fem::SparseMatrix springs, std::vector<int> prescribed,
                   fem::FiniteNewtonOptions how, fem::LinearSolver linear,
                   std::shared_ptr<const fem::NodeOrder> order);

  FiniteCorrection(const FiniteCorrection&) = delete;

  /// The moment: 3 |nodes|, m.
  void begin(const Eigen::VectorXd& d0);
  /// The displacement under `more` (3 |nodes|, N), the iterations beginning at `guess` (m), or
  /// without it where the last answer was. Throws NumericalError where none is found; the next
  /// answer then begins at d0 again.
  const Eigen::VectorXd& under(const Eigen::VectorXd& more, const Eigen::VectorXd* guess = nullptr);

  int iterations() const { return iterations_; }  ///< of all answers
  int factorisations() const { return factorisations_; }

 private:
  void start();
  fem::FiniteStrain form_;
  fem::SparseMatrix springs_;
  std::optional<fem::FiniteNewton> newton_;
  Eigen::VectorXd d0_, force_, prescribed_;
  int iterations_ = 0, factorisations_ = 0;
};

}  // namespace hyperex::simulate
