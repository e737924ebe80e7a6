// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <vector>

#include "hyperex/fem/form/assembler.hpp"
#include "hyperex/fem/form/nodal_potential.hpp"
#include "hyperex/fem/material/hyperelastic.hpp"

namespace hyperex::fem {

/// Backward difference for the rate at the end of a step: d' = now d(t+1) + last d(t) + before
/// d(t-1). The three coefficients (1/s) sum to zero. All zero means no rates, as in statics.
struct RateRule {
  double now = 0, last = 0, before = 0;
  double step_s = 0;
};

/// Energy, nodal forces and stiffness of a mesh at large displacements. The energy is
///   sum_e V_e (W(F_e) + barrier(J_e) + kappa'_e / 2 (J_e - 1)^2)
///     + sum_g V_g kappa_g / 2 (J_g - 1)^2,
/// with F = I + grad u and J = det F; on a mesh that has grown (Assembler::grown), F and V_e are
/// relative to the grown element at rest. J_g is the mean volume ratio of a dilatation group;
/// kappa' and kappa_g are as in form/dilatation_groups.hpp. At d = 0, the second derivatives are
/// the stiffness of the linear formulation. Within a time step, the potentials of viscosity and of
/// Maxwell branches are added (begin_step()). The results do not depend on the number of threads.
/// All memory is allocated at construction. Must not be used by several threads at once.
class FiniteStrain {
 public:
  /// `mesh` must outlive this object. Throws InputError if the viscous form of the material is not
  /// isotropic, if the law is not admissible, or if a tetrahedron has inadmissible material values.
  FiniteStrain(const Assembler& mesh, const Material& material, const Hyperelastic& law);

  const Assembler& mesh() const { return mesh_; }
  const Hyperelastic& law() const { return law_; }
  /// Sets other material values with the same law. The history of the branches is discarded.
  void set_material(const Material& material);

  /// The law of small strain: its tangent is the same at any displacement.
  bool linear() const { return law_.law == HyperelasticLaw::linear; }

  /// Begins the step from `last` (the displacement at t; `before` is that at t-1). From now on,
  /// energy(), its gradient and tangent() include the potentials of the step from `last` to their
  /// argument. The potential of viscosity is
  ///   sum_e V_e eta J* now |E - E^|^2,  |X|^2 = tr(A X A X) - tr(A X)^2 / 3,  A = (C*)^-1.
  /// E is the Green-Lagrange strain. With E^ = -(last E(t) + before E(t-1)) / now, the strain rate
  /// is now (E - E^). C* is C = F^T F extrapolated to the end of the step, and J* = sqrt(det C*).
  /// If rule.before is 0, and otherwise in elements whose strain changed by more than 0.1 in the
  /// previous step, backward Euler is used instead: the rate (E - E(t)) / h and C* = C(t). The
  /// stress of this potential is Stokes' law, 2 eta dev(D). At small strain it equals that of the
  /// linear formulation, and a rigid rotation produces none. The potential of a Maxwell branch with
  /// ratio g and time constant tau is, with h the step,
  ///   delta W + (exp(-h / tau) Q(t) - delta S(t)) : E,   delta = g (1 - exp(-h / tau)) tau / h.
  /// S is the second Piola-Kirchhoff stress of the law (of W alone, without the barrier and the
  /// volumetric parts); Q is that of the branch. This is exact if S is linear in time within the
  /// step.
  void begin_step(const RateRule& rule, const Eigen::VectorXd& last, const Eigen::VectorXd& before);
  /// Ends the step at displacement `d` and updates the stresses of the branches. The potentials of
  /// the step remain until the next begin_step().
  void accept(const Eigen::VectorXd& d);
  /// Removes rates and history, as if the body had always been at `d`.
  void rest_at(const Eigen::VectorXd& d);

  /// The energy (J) of all potentials above at d (3 |nodes|). `gradient` := its derivatives (N).
  double energy_and_gradient(const Eigen::VectorXd& d, Eigen::VectorXd& gradient);
  double energy(const Eigen::VectorXd& d);
  /// Rounding error of energies near rest (J). The terms of the laws, which are of the order of
  /// shear modulus times volume, cancel there. Differences of energies below this value are
  /// meaningless.
  double energy_rounding() const { return energy_rounding_; }
  /// Energy (J) stored by the law, the barrier and the volumetric terms, without viscosity and
  /// branches.
  double elastic_energy(const Eigen::VectorXd& d);

  /// `matrix` := second derivatives of the energy at d + mass_share M. Its pattern is created if it
  /// is not that of System::stiffness yet. `projected`: the contribution of each element is made
  /// positive semidefinite (Teran et al., Robust Quasistatic Finite Elements and Flesh Simulation,
  /// 2005). This takes four times as long; use it if the exact matrix is not positive definite.
  void tangent(const Eigen::VectorXd& d, double mass_share, bool projected, SparseMatrix& matrix);

  /// out := M u, with the consistent mass matrix M.
  void mass_product(const Eigen::VectorXd& u, Eigen::VectorXd& out) const;

  // At displacement d, one entry per element:
  std::vector<Eigen::Matrix3d> deformation_gradient(const Eigen::VectorXd& d) const;
  Eigen::VectorXd volume_ratio(const Eigen::VectorXd& d) const;  ///< J
  VoigtRows green_lagrange(const Eigen::VectorXd& d) const;      ///< engineering shear
  /// Cauchy stress (Pa) of law, barrier and volumetric terms, with the pressure of the element's
  /// groups. As in stress_pa() of the linear formulation, viscosity and branches are excluded. NaN
  /// where J <= 0.
  VoigtRows cauchy_stress_pa(const Eigen::VectorXd& d);
  Points principal_stretches(const Eigen::VectorXd& d) const;  ///< increasing

 private:
  struct Element;
  struct StepData {
    Eigen::Matrix3d metric;  // C*^-1
    Eigen::Matrix3d strain;  // E^
    Eigen::Matrix3d stress;  // sum of the branches, constant within the step
    double viscosity;        // 2 eta J* now
  };
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
  std::vector<double> mass_;  // one per pair of nodes, in the pattern of mesh.mass_neighbours()
  std::vector<double> element_mass_;  // rho V / 20
  // Positions of the corners, for each entry of mesh.groups().
  std::vector<std::array<int, 4>> group_places_;

  // Data of the current step.
  double branch_share_ = 0;  // sum of delta
  std::vector<StepData> step_;
  std::vector<double> fade_, share_;                  // per branch: exp(-h / tau), delta
  std::vector<Eigen::Matrix3d> law_stress_;           // S at the last accepted displacement
  std::vector<std::vector<Eigen::Matrix3d>> branch_;  // Q at the last accepted displacement

  // At the displacement of the last evaluation.
  std::vector<Eigen::Matrix3d> f_, piola_;
  std::vector<double> ratio_, element_energy_, pressure_;
  std::vector<double> group_ratio_;
  std::vector<Vec3> group_gradient_;
  std::vector<double> blocks_;  // per element, the six 3 x 3 blocks off the diagonal
};

/// Von Mises stress of each element, in the unit of `stress`; NaN where the stress is NaN.
Eigen::VectorXd von_mises_of(const VoigtRows& stress);

}  // namespace hyperex::fem
