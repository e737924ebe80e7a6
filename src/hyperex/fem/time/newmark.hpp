// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <vector>

#include "hyperex/fem/form/system.hpp"

namespace hyperex::fem {

/// Average-acceleration Newmark (beta = 1/4, delta = 1/2) on a system whose prescribed unknowns c
/// follow a given displacement and whose free unknowns o bear no external force unless given one:
///   A_oo d_o(t+1) = f_o + q_o(t) - A_oc d_c(t+1),  A = K + 4/dt^2 M + 2/dt C.
/// A_oo is factored once (CHOLMOD, supernodal); step() allocates nothing of the size of the model.
class Newmark {
 public:
  /// `prescribed`: sorted unique unknowns 3 n + axis. Throws NumericalError where A_oo is not
  /// positive definite. All start values are zero.
  Newmark(const System& system, std::vector<int> prescribed, double dt_s);
  ~Newmark();
  Newmark(Newmark&&) noexcept;

  /// Advances by dt. `prescribed_next`: displacement of the prescribed unknowns at t+1 (m), in the
  /// order of `prescribed`. Driven velocity and acceleration follow from Newmark's formulas.
  void step(const Eigen::VectorXd& prescribed_next);
  /// The same with external forces on all unknowns at t+1 (N; those on prescribed ones are ignored).
  void step(const Eigen::VectorXd& prescribed_next, const Eigen::VectorXd& force_next);

  /// Sets the state of all unknowns (3 |nodes| each).
  void set_state(const Eigen::VectorXd& d, const Eigen::VectorXd& v, const Eigen::VectorXd& a);
  const Eigen::VectorXd& displacement() const;  ///< 3 |nodes|, m
  const Eigen::VectorXd& velocity() const;      ///< m/s
  const Eigen::VectorXd& acceleration() const;  ///< m/s^2
  int free_count() const;
  double factor_seconds() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace hyperex::fem
