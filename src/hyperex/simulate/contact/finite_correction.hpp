// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <optional>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/time/finite_newton.hpp"

namespace hyperex::simulate {

/// The response of tissue at finite strain to further forces at one moment of its motion. All other
/// forces, inertia and viscosity included, stay as they are at that moment. With f(d) the forces of
/// elasticity and springs at displacement d, and d0 the displacement at the moment, the response to
/// `more` is the d where f(d) = f(d0) + more on the free unknowns. Maxwell branches are taken as
/// relaxed. Only one moment is stored.
class FiniteCorrection {
 public:
  /// `springs`: on the pattern of System::stiffness; no columns: none. `prescribed`: unknowns that
  /// keep their value in d0. `order`: as for FiniteNewton. `assembler` must outlive this.
  FiniteCorrection(const fem::Assembler& assembler, const fem::Material& material,
                   fem::Hyperelastic law, fem::SparseMatrix springs, std::vector<int> prescribed,
                   fem::FiniteNewtonOptions how, std::shared_ptr<const fem::NodeOrder> order);

  FiniteCorrection(const FiniteCorrection&) = delete;

  /// Sets the displacement at the moment: 3 |nodes|, m.
  void begin(const Eigen::VectorXd& d0);
  /// The displacement under `more` (3 |nodes|, N). The iterations begin at `guess` (m) or, without
  /// it, at the last answer. Throws NumericalError where no equilibrium is found; the next search
  /// then begins at d0 again.
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
