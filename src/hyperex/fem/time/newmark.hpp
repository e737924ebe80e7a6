// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/fem/form/system.hpp"
#include "hyperex/fem/solve/node_order.hpp"

namespace hyperex::fem {

/// Newmark's method:
///   d1 = d + h v + h^2 ((1/2 - beta) a + beta a1),  v1 = v + h ((1 - gamma) a + gamma a1).
/// (beta, gamma) = (1/4, 1/2) is the average acceleration method: second order, unconditionally
/// stable, without numerical damping. Other values must satisfy 2 beta >= gamma >= 1/2
/// (unconditional stability).
struct NewmarkOptions {
  double dt_s = 0.002;
  double beta = 0.25, gamma = 0.5;
};

/// Displacement (m), velocity and acceleration of the same unknowns.
struct Kinematics {
  Eigen::VectorXd d, v, a;
};

/// Newmark's method for a system in which the motion of the prescribed unknowns c is given with its
/// two time derivatives, and external forces f act on the free unknowns o:
///   A_oo d_o(t+1) = f_o + q_oo(t) - (K_oc d_c + C_oc d'_c + M_oc d''_c)(t+1),
///   A = K + gamma/(beta h) C + 1/(beta h^2) M,  q_oo from the free columns alone [after 4.37].
/// A_oo is factored once; step() allocates nothing.
class Newmark {
 public:
  /// `prescribed`: sorted unique unknowns 3 n + axis. `order`: see PartitionedFactor. The initial
  /// state is zero. Throws NumericalError if A_oo is not positive definite.
  Newmark(System system, std::vector<int> prescribed, const NewmarkOptions& options,
          std::shared_ptr<const NodeOrder> order = nullptr);
  ~Newmark();
  Newmark(Newmark&&) noexcept;

  /// Replaces the values of the matrices on the same patterns. The ordering is kept; the state is
  /// reset to zero.
  void refill(System system);

  /// Sets displacement and velocity of all unknowns (3 |nodes|) and the acceleration of the
  /// prescribed ones. The acceleration of the free unknowns follows from the equation of motion at
  /// this time. `force`: all unknowns (N; those on prescribed ones are ignored); empty: none.
  void start(const Eigen::VectorXd& d, const Eigen::VectorXd& v,
             const Eigen::VectorXd& prescribed_acceleration, const Eigen::VectorXd& force = {});

  /// Sets the whole state of all unknowns (3 |nodes| each), which need not be in equilibrium.
  void set_state(const Eigen::VectorXd& d, const Eigen::VectorXd& v, const Eigen::VectorXd& a);

  /// Advances by dt. `next`: state of the prescribed unknowns at t+1, in their order. `force`: as
  /// above.
  void step(const Kinematics& next, const Eigen::VectorXd& force = {});
  /// The same if only their displacement is known. Velocity and acceleration of the prescribed
  /// unknowns then follow from Newmark's formulas [4.35 - 4.37].
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
