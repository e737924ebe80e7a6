// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// Newmark's method on dense matrices, written for the accelerations from predicted states. The
// partitioned sparse integrator, written for the displacements, is compared with it.
#include <vector>

#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::test {

struct DenseNewmark {
  Eigen::MatrixXd m, c, k;
  std::vector<int> prescribed, free;
  double dt, beta, gamma;
  Eigen::VectorXd d, v, a;

  DenseNewmark(const fem::System& s, const std::vector<int>& prescribed_,
               const fem::NewmarkOptions& options)
      : m(s.mass),
        c(s.damping),
        k(s.stiffness),
        prescribed(prescribed_),
        free(complement(m.rows(), prescribed_)),
        dt(options.dt_s),
        beta(options.beta),
        gamma(options.gamma) {
    d = v = a = Eigen::VectorXd::Zero(m.rows());
  }

  Eigen::VectorXd predicted_d() const { return d + dt * v + dt * dt * (0.5 - beta) * a; }
  Eigen::VectorXd predicted_v() const { return v + dt * (1 - gamma) * a; }

  /// The residual of the equation of motion, M a + C v + K d - f. On prescribed unknowns it is the
  /// reaction.
  Eigen::VectorXd lacking(const Eigen::VectorXd& force) const {
    return m * a + c * v + k * d - force;
  }

  void start(const Eigen::VectorXd& d0, const Eigen::VectorXd& v0,
             const Eigen::VectorXd& prescribed_acceleration, const Eigen::VectorXd& force) {
    d = d0;
    v = v0;
    a.setZero();
    a(prescribed) = prescribed_acceleration;
    const Eigen::MatrixXd m_oo = m(free, free);
    const Eigen::VectorXd r = lacking(force)(free);
    a(free) = Eigen::VectorXd(-m_oo.llt().solve(r));
  }

  /// The velocity and acceleration of the prescribed unknowns that Newmark's formulas give for a
  /// displacement.
  fem::Kinematics consistent(const Eigen::VectorXd& given) const {
    const Eigen::VectorXd next = (given - predicted_d()(prescribed)) / (beta * dt * dt);
    return {given, predicted_v()(prescribed) + gamma * dt * next, next};
  }

  void step(const fem::Kinematics& given, const Eigen::VectorXd& force) {
    const Eigen::VectorXd d_pre = predicted_d(), v_pre = predicted_v();
    d = d_pre;
    v = v_pre;
    a.setZero();
    d(prescribed) = given.d;
    v(prescribed) = given.v;
    a(prescribed) = given.a;
    const Eigen::MatrixXd effective = (m + gamma * dt * c + beta * dt * dt * k)(free, free);
    const Eigen::VectorXd r = lacking(force)(free);
    const Eigen::VectorXd next = -effective.partialPivLu().solve(r);
    a(free) = next;
    v(free) += gamma * dt * next;
    d(free) += beta * dt * dt * next;
  }
  void step(const Eigen::VectorXd& given, const Eigen::VectorXd& force) {
    step(consistent(given), force);
  }
};

}  // namespace hyperex::test
