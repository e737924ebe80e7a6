// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/form/nodal_potential.hpp"
#include "hyperex/fem/material/hyperelastic.hpp"

namespace hyperex::fem {

/// How the rate at the end of a step follows from displacements: d' = now d(t+1) + last d(t) +
/// before d(t-1); the three sum to zero. 1/s. All zero: no rates, as in statics.
struct RateRule {
  double now = 0, last = 0, before = 0;
  double step_s = 0;
};

/// Energy, forces and stiffness of a mesh at large displacements:
///   sum_e V_e (W(F_e) + barrier(J_e) + kappa'_e / 2 (J_e - 1)^2)
///     + sum_g V_g kappa_g / 2 (J_g - 1)^2,
/// F = I + grad u, J = det F, J_g the mean ratio of volumes of a dilatation group, kappa' and
/// kappa_g as there (form/dilatation_groups.hpp). At d = 0 its second derivatives are the linear
/// form's stiffness. Within a step of time the potentials of viscosity and of Maxwell branches are
/// added: begin_step(). Sums do not depend on the number of threads. Memory is taken when it is
/// made; one caller at a time.
class FiniteStrain {
 public:
  /// `mesh` must outlive this. Throws InputError where the material's viscous form is not
  /// isotropic, the law is not admissible or a tetrahedron has values that no material has.
  FiniteStrain(const Assembler& mesh, const Material& material, const Hyperelastic& law);

  const Assembler& mesh() const { return mesh_; }
  const Hyperelastic& law() const { return law_; }
  /// Other values, the same law; history is forgotten.
  void set_material(const Material& material);

  /// From now on energy(), its gradient and tangent() hold what belongs to the step that leads from
  /// `last` (displacement at t; `before` at t-1) to their argument. The viscosity's potential is
  ///   sum_e V_e eta J* now |E - E^|^2,  |X|^2 = tr(A X A X) - tr(A X)^2 / 3,  A = (C*)^-1,
  /// E being Green-Lagrange's strain, E^ = -(last E(t) + before E(t-1)) / now, so that now (E - E^)
  /// is its rate; C* and J* = sqrt(det C*) are C = F^T F extrapolated to the end of the step. Where
  /// rule.before is 0, and in elements whose strain changed by more than 0.1 in the step before,
  /// the rate is (E - E(t)) / h and C* = C(t) instead (backward Euler). Its stress is Stokes' law,
  /// 2 eta dev(D); at small strain it is that of the linear form, and rotations cost nothing. The
  /// potential of a branch of ratio g and time tau is, h being the step,
  ///   delta W + (exp(-h / tau) Q(t) - delta S(t)) : E,   delta = g (1 - exp(-h / tau)) tau / h,
  /// with S the law's second Piola-Kirchhoff stress (its part W alone, without barrier and
  /// volumetric parts) and Q the branch's: exact where S is linear in time within the step.
  void begin_step(const RateRule& rule, const Eigen::VectorXd& last, const Eigen::VectorXd& before);
  /// Ends it at `d`: branches take over their stress. Their potentials and that of the viscosity
  /// stay until the next begin_step().
  void accept(const Eigen::VectorXd& d);
  /// No rates, no history: the body has been at `d` forever.
  void rest_at(const Eigen::VectorXd& d);

  /// The energy (J) at d (3 |nodes|) of all potentials above; `gradient` := its derivatives (N).
  double energy_and_gradient(const Eigen::VectorXd& d, Eigen::VectorXd& gradient);
  double energy(const Eigen::VectorXd& d);
  /// What rounding makes of energies near rest (J), where the terms of the laws, of the size of
  /// shear modulus times volume, cancel: differences below it say nothing.
  double energy_rounding() const { return energy_rounding_; }
  /// What the law, the barrier and the volumes store, without viscosity and branches (J).
  double elastic_energy(const Eigen::VectorXd& d);

  /// `matrix` := second derivatives + mass_share M at d; its pattern is made where it is not that
  /// of System::stiffness already. `projected`: each element's part is made positive semidefinite
  /// (Teran et al., Robust Quasistatic Finite Elements and Flesh Simulation, 2005), four times as
  /// slow: for where the exact matrix is not positive definite.
  void tangent(const Eigen::VectorXd& d, double mass_share, bool projected, SparseMatrix& matrix);

  /// out := M u; M is the consistent mass.
  void mass_product(const Eigen::VectorXd& u, Eigen::VectorXd& out) const;

  // At displacement d, one entry per element:
  std::vector<Eigen::Matrix3d> deformation_gradient(const Eigen::VectorXd& d) const;
  Eigen::VectorXd volume_ratio(const Eigen::VectorXd& d) const;  ///< J
  VoigtRows green_lagrange(const Eigen::VectorXd& d) const;      ///< engineering shear
  /// Of law, barrier and volumes (Pa), with the pressure of the element's groups; without viscosity
  /// and branches, as stress_pa() of the linear form. NaN where J <= 0.
  VoigtRows cauchy_stress_pa(const Eigen::VectorXd& d);
  Points principal_stretches(const Eigen::VectorXd& d) const;  ///< rising

 private:
  struct Element;
  struct StepData {
    Eigen::Matrix3d metric;  // C*^-1
    Eigen::Matrix3d strain;  // E^
    Eigen::Matrix3d stress;  // of the branches, constant in the step
    double viscosity;        // 2 eta J* now
  };
  bool linear() const { return law_.law == HyperelasticLaw::linear; }
  bool has_rates() const { return viscous_ || !law_.branches.empty(); }
  Eigen::Matrix3d gradient_at(const Eigen::VectorXd& d, Eigen::Index t) const;
  double ratio_of(const Eigen::Matrix3d& f) const;
  Eigen::Matrix3d ratio_gradient(const Eigen::Matrix3d& f) const;
  Eigen::Matrix3d strain_of(const Eigen::Matrix3d& f) const;
  Eigen::Matrix3d law_stress(const Eigen::Matrix3d& f, double shear_pa) const;
  void set_viscous_step(Eigen::Index t, const RateRule& rule, double w, const Eigen::Matrix3d& f,
                        const Eigen::VectorXd& before);
  void find_kinematics(const Eigen::VectorXd& d);
  double evaluate(const Eigen::VectorXd& d, bool step, Eigen::VectorXd* gradient);
  void find_group_gradients();
  Element element_at(Eigen::Index t) const;
  void find_blocks(bool projected);

  const Assembler& mesh_;
  Hyperelastic law_;
  std::vector<Assembler::Moduli> moduli_;
  std::vector<double> group_stiffness_;  // kappa_g V_g
  std::vector<double> viscosity_;
  bool viscous_ = false;
  double energy_rounding_ = 0;
  std::vector<double> mass_;                      // of pairs of nodes, on mesh.mass_neighbours()
  std::vector<double> element_mass_;              // rho V / 20
  std::vector<std::array<int, 4>> group_places_;  // of corners, for each entry of mesh.groups()

  // Of a step.
  double branch_share_ = 0;  // sum of delta
  std::vector<StepData> step_;
  std::vector<double> fade_, share_;                  // of each branch: exp(-h / tau), delta
  std::vector<Eigen::Matrix3d> law_stress_;           // S at the last accepted displacement
  std::vector<std::vector<Eigen::Matrix3d>> branch_;  // Q there

  // At the displacement of the last evaluation.
  std::vector<Eigen::Matrix3d> f_, piola_;
  std::vector<double> ratio_, element_energy_, pressure_;
  std::vector<double> group_ratio_;
  std::vector<Vec3> group_gradient_;
  std::vector<double> blocks_;  // six 3 x 3 off the diagonal of each element
};

/// Per element: von Mises stress of a stress, in its unit. NaN where the stress is.
Eigen::VectorXd von_mises_of(const VoigtRows& stress);

}  // namespace hyperex::fem
