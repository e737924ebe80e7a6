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
  /// A step ends where what is still missing, estimated from the last two corrections, is below
  /// this share of the greatest displacement of a node, or of least_motion_m where that is more.
  double tolerance = 1e-3;
  double least_motion_m = 1e-4;
  int most_iterations = 25;  ///< of a step, before it is halved
  int most_halvings = 8;     ///< a step is taken in at most 2^8 parts
  /// True: the matrix is factored in each iteration. False: a factor serves as many steps as it
  /// pays, and a new one is made where it converges slowly; corrections with an old factor are
  /// bettered by L-BFGS.
  bool full_newton = false;
  bool inertia = true;  ///< false: M is left out of the equation of motion
};

/// What may be done between the parts of a step. Each may be empty.
struct FiniteNewtonHooks {
  /// Before each iteration: `d` is the present iterate (3 |nodes|, m), `t_s` the time since start()
  /// that it is to be that of, and `force` the external forces (N), which may be overwritten: those
  /// of muscles that turn with the tissue. A force that depends on d takes part in the iterations,
  /// but not in their matrix.
  std::function<void(const Eigen::VectorXd& d, double t_s, Eigen::VectorXd& force)>
      before_iteration;
  /// After each part of a step that was accepted, at time t (s) since start(): for progress; may
  /// throw to cancel, and then the state is that at t.
  std::function<void(double t_s)> after_part;
};

struct FiniteStepReport {
  int parts = 0;  ///< 1: the step as it was given
  int iterations = 0, factorisations = 0, projections = 0;
  /// Estimated, as a share of the greatest displacement. Above the tolerance only where rounding
  /// hides what is left, at tolerances below 1e-7.
  double error = 0;
};

/// Motion of a body at finite strain: M d'' + dPsi/dd(d, d') = f with some unknowns prescribed, by
/// BDF2 with variable steps (its second-order backward difference for d' and for d''), backward
/// Euler where there is no step before of at least half the length. Of order 2, and stiff modes,
/// those of volume and of viscosity, fade at once whatever the step: Newmark's average acceleration
/// keeps them ringing, and is not stable without conditions where stiffness changes with d. Every
/// step makes an incremental potential least, by Newton's method with a line search. Equations and
/// sources: docs/mechanics.md.
///
/// A step allocates nothing after the first, except what the hooks and TBB's own pools do.
class FiniteNewton {
 public:
  /// `form` must outlive this; one integrator uses it at a time. `prescribed`: sorted unique
  /// unknowns 3 n + axis. `springs`: constant, symmetric, on the pattern of System::stiffness (of
  /// nodes to the ground: blocks on the diagonal); no columns: none. Their force is -springs d:
  /// where they pull to elsewhere, springs * target belongs to the external force. Throws
  /// NumericalError where the matrix at rest is not positive definite, InputError naming an entry
  /// where one that was handed in is out of range or no finite number; so do start(), step() and
  /// equilibrium(). `order`: PartitionedFactor.
  FiniteNewton(FiniteStrain& form, std::vector<int> prescribed, const FiniteNewtonOptions& options,
               SparseMatrix springs = {}, std::vector<const NodalPotential*> potentials = {},
               std::shared_ptr<const NodeOrder> order = nullptr);
  ~FiniteNewton();
  FiniteNewton(FiniteNewton&&) noexcept;

  /// At time 0 in state d (m), v (m/s; 3 |nodes| each), at rest before as far as viscous branches
  /// are concerned. Without: zero. `force` (N; empty: none): what acts until then; where a step is
  /// halved, forces grow from there.
  void start(const Eigen::VectorXd& d, const Eigen::VectorXd& v, const Eigen::VectorXd& force = {});
  void start();

  /// Advances by dt_s to prescribed displacements `prescribed` (in their order, m) under `force`
  /// (3 |nodes|, N; those on prescribed unknowns are ignored; empty: none). Where a step does not
  /// converge it is halved, prescribed displacements and forces taken linearly between their values
  /// at both ends, and what follows is taken in parts that may double again. `guess`: displacement
  /// at the end (3 |nodes|; say, the linear answer) to start the iterations from; null: the last
  /// ones extrapolated.
  /// Throws NumericalError where the shortest part does not converge: it names the time and the
  /// node and element that are worst; the state is then that after the last accepted part.
  FiniteStepReport step(double dt_s, const Eigen::VectorXd& prescribed,
                        const Eigen::VectorXd& force = {}, const FiniteNewtonHooks& hooks = {},
                        const Eigen::VectorXd* guess = nullptr);

  /// The same without time: equilibrium of elastic forces (no inertia, no viscosity; branches
  /// relaxed), reached from the present state in one part or several. Time does not advance;
  /// velocity and acceleration are zero after it.
  FiniteStepReport equilibrium(const Eigen::VectorXd& prescribed, const Eigen::VectorXd& force = {},
                               const FiniteNewtonHooks& hooks = {},
                               const Eigen::VectorXd* guess = nullptr);

  double time_s() const;
  const Eigen::VectorXd& displacement() const;  ///< 3 |nodes|, m
  const Eigen::VectorXd& velocity() const;      ///< m/s, by the backward difference
  const Eigen::VectorXd& acceleration() const;  ///< m/s^2, likewise
  /// What acts on the prescribed unknowns besides `force`, all unknowns (N): inertia, inner forces
  /// and springs less external forces at the end of the last step; on free unknowns the residual.
  const Eigen::VectorXd& reaction() const;

  const std::vector<int>& prescribed() const;
  int free_count() const;
  const std::shared_ptr<const NodeOrder>& order() const;

  /// x := A^-1 x among the free unknowns (3 |nodes|; prescribed rows become zero) with the factor
  /// at hand: the displacement (m) that forces (N) make, to first order. For hooks that correct
  /// forces.
  void solve(Eigen::VectorXd& x);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
