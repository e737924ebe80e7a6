// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <functional>
#include <memory>
#include <vector>

#include "hyperex/fem/form/finite_strain.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/fem/time/newmark.hpp"

namespace hyperex::fem {

struct FiniteNewtonOptions {
  /// A step ends when the remaining error, estimated from the last two corrections, is below this
  /// share of the greatest displacement of a node, or of least_motion_m if that is greater.
  double tolerance = 1e-3;
  double least_motion_m = 1e-4;
  int most_iterations = 25;  ///< per step, before it is halved
  int most_halvings = 8;     ///< a step is divided into at most 2^8 parts
  /// True: the matrix is factored in each iteration. False: a factor is reused for as many steps as
  /// is efficient and renewed when convergence is slow; corrections with an old factor are improved
  /// by L-BFGS.
  bool full_newton = false;
  bool inertia = true;  ///< false: the inertia term M d'' is omitted
};

/// Functions that are called during a step. Each may be empty.
struct FiniteNewtonHooks {
  /// Called before each iteration. `d`: the current iterate (3 |nodes|, m). `t_s`: the time since
  /// start() at the end of the current part. `force`: the external forces (N), which may be
  /// overwritten, for example by those of muscles that rotate with the tissue. A force that depends
  /// on d is updated in each iteration, but its derivative is not in the matrix.
  std::function<void(const Eigen::VectorXd& d, double t_s, Eigen::VectorXd& force)>
      before_iteration;
  /// Called after each accepted part of a step, at time t (s) since start(), for example to show
  /// progress. It may throw to cancel; the state is then that at t.
  std::function<void(double t_s)> after_part;
};

struct FiniteStepReport {
  int parts = 0;  ///< 1: the step was not divided
  int iterations = 0, factorisations = 0, projections = 0;
  /// Estimated, as a share of the greatest displacement. It exceeds the tolerance only if rounding
  /// hides the remaining error, at tolerances below 1e-7.
  double error = 0;
};

/// Motion of a body at finite strain with some unknowns prescribed: M d'' + dPsi/dd(d, d') = f.
/// Time integration is by BDF2 with variable steps: its second-order backward difference is used
/// for d' and for d''. If the previous step is shorter than half of this one, or absent, backward
/// Euler is used. The method is of order 2. Stiff modes, those of volume change and viscosity,
/// decay at once for any step size. With Newmark's average acceleration they would oscillate;
/// moreover, that method is not unconditionally stable if the stiffness depends on d. Every step
/// minimises an incremental potential by Newton's method with a line search. Equations and sources:
/// docs/mechanics.md.
///
/// After the first step, a step allocates nothing, except in hooks and in TBB's own pools.
class FiniteNewton {
 public:
  /// `form` must outlive this object, and only one integrator may use it at a time. `prescribed`:
  /// sorted unique unknowns 3 n + axis. `springs`: a constant symmetric matrix on the pattern of
  /// System::stiffness (springs between nodes and the ground are diagonal blocks); no columns:
  /// none. Their force is -springs d; if their rest position is `target`, add springs * target to
  /// the external force. `order`: see PartitionedFactor. Throws NumericalError if the matrix at
  /// rest is not positive definite. Throws InputError naming an argument's entry that is out of
  /// range or not a finite number; so do start(), step() and equilibrium().
  FiniteNewton(FiniteStrain& form, std::vector<int> prescribed, const FiniteNewtonOptions& options,
               SparseMatrix springs = {}, std::vector<const NodalPotential*> potentials = {},
               std::shared_ptr<const NodeOrder> order = nullptr);
  ~FiniteNewton();
  FiniteNewton(FiniteNewton&&) noexcept;

  /// Sets the state at time 0: displacement d (m) and velocity v (m/s), 3 |nodes| each. Without
  /// arguments, both are zero. Viscous branches start as if the body had always been at d. `force`
  /// (N; empty: none): the external forces up to this time. If a step is halved, forces are
  /// interpolated from these.
  void start(const Eigen::VectorXd& d, const Eigen::VectorXd& v, const Eigen::VectorXd& force = {});
  void start();

  /// Advances by dt_s to the prescribed displacements `prescribed` (m, in the order of the
  /// prescribed unknowns) under `force` (3 |nodes|, N; forces on prescribed unknowns are ignored;
  /// empty: none). If a step does not converge, it is halved; prescribed displacements and forces
  /// are then interpolated linearly, and later parts may double in size again. `guess`: a starting
  /// value for the displacement at the end (3 |nodes|), such as the linear solution; null:
  /// extrapolated from the last states. Throws NumericalError if the shortest part does not
  /// converge. The message names the time and the worst node and element; the state is that after
  /// the last accepted part.
  FiniteStepReport step(double dt_s, const Eigen::VectorXd& prescribed,
                        const Eigen::VectorXd& force = {}, const FiniteNewtonHooks& hooks = {},
                        const Eigen::VectorXd* guess = nullptr);

  /// Static equilibrium of elastic forces, without inertia and viscosity and with relaxed branches.
  /// It is reached from the current state in one or more parts. Time does not advance. Velocity and
  /// acceleration are zero afterwards.
  FiniteStepReport equilibrium(const Eigen::VectorXd& prescribed, const Eigen::VectorXd& force = {},
                               const FiniteNewtonHooks& hooks = {},
                               const Eigen::VectorXd* guess = nullptr);

  double time_s() const;
  const Eigen::VectorXd& displacement() const;  ///< 3 |nodes|, m
  const Eigen::VectorXd& velocity() const;      ///< m/s, by the backward difference
  const Eigen::VectorXd& acceleration() const;  ///< m/s^2, by the backward difference
  /// Reaction forces of all unknowns (N) at the end of the last step: inertia, internal forces and
  /// springs minus external forces. On free unknowns, this is the residual.
  const Eigen::VectorXd& reaction() const;

  const std::vector<int>& prescribed() const;
  int free_count() const;
  const std::shared_ptr<const NodeOrder>& order() const;

  /// x := A^-1 x on the free unknowns (3 |nodes|; prescribed rows become zero), using the current
  /// factor, rotated with the tissue: to first order, the displacement (m) caused by the forces x
  /// (N). For hooks that correct forces.
  void solve(Eigen::VectorXd& x);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
