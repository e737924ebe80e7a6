// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/solve/node_order.hpp"

namespace hyperex::fem {

/// Newmark's method: d1 = d + h v + h^2 ((1/2 - beta) a + beta a1), v1 = v + h ((1 - gamma) a +
/// gamma a1). (1/4, 1/2) is average acceleration: order 2, unconditionally stable, no damping of
/// its own. Other values must keep 2 beta >= gamma >= 1/2 (unconditional stability).
struct NewmarkOptions {
  double dt_s = 0.002;
  double beta = 0.25, gamma = 0.5;
};

/// Displacement (m), velocity and acceleration of the same unknowns.
struct Kinematics {
  Eigen::VectorXd d, v, a;
};

/// Newmark on a system whose prescribed unknowns c follow a motion given with its two derivatives
/// and whose free unknowns o bear external forces f:
///   A_oo d_o(t+1) = f_o + q_oo(t) - (K_oc d_c + C_oc d'_c + M_oc d''_c)(t+1),
///   A = K + gamma/(beta h) C + 1/(beta h^2) M,  q_oo from the free columns alone [after 4.37].
/// A_oo is factored once; step() allocates nothing.
class Newmark {
 public:
  /// `prescribed`: sorted unique unknowns 3 n + axis. Throws NumericalError where A_oo is not
  /// positive definite. All start values are zero. `order`: PartitionedFactor.
  Newmark(System system, std::vector<int> prescribed, const NewmarkOptions& options,
          std::shared_ptr<const NodeOrder> order = nullptr);
  ~Newmark();
  Newmark(Newmark&&) noexcept;

  /// Other values on the same patterns: keeps the ordering; the state goes back to zero.
  void refill(System system);

  /// Sets displacement and velocity of all unknowns (3 |nodes|) and the acceleration of the
  /// prescribed ones; that of the free ones follows from the equation of motion at this time.
  /// `force`: all unknowns (N; those on prescribed ones are ignored), empty: none.
  void start(const Eigen::VectorXd& d, const Eigen::VectorXd& v,
             const Eigen::VectorXd& prescribed_acceleration, const Eigen::VectorXd& force = {});

  /// Sets all of all unknowns (3 |nodes| each), whether or not they are in equilibrium.
  void set_state(const Eigen::VectorXd& d, const Eigen::VectorXd& v, const Eigen::VectorXd& a);

  /// Advances by dt. `next`: the prescribed unknowns at t+1, in their order. `force`: as above.
  void step(const Kinematics& next, const Eigen::VectorXd& force = {});
  /// The same where only the displacement is known: velocity and acceleration of the prescribed
  /// unknowns follow from Newmark's own formulas [4.35 - 4.37].
  void step(const Eigen::VectorXd& prescribed_next, const Eigen::VectorXd& force = {});

  const Eigen::VectorXd& displacement() const { return state().d; }  ///< 3 |nodes|, m
  const Eigen::VectorXd& velocity() const { return state().v; }      ///< m/s
  const Eigen::VectorXd& acceleration() const { return state().a; }  ///< m/s^2
  const Kinematics& state() const;
  int free_count() const;
  double analyse_seconds() const;
  double factor_seconds() const;
  double factor_entries() const;  ///< stored numbers of the factor, 8 bytes each
  const std::shared_ptr<const NodeOrder>& order() const;
  const std::vector<int>& prescribed() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
