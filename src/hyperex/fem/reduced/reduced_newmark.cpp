// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/reduced/reduced_newmark.hpp"

#include <Eigen/Eigenvalues>

namespace hyperex::fem {

ReducedMotion integrate_reduced(const Eigen::MatrixXd& stiffness, const Eigen::MatrixXd& damping,
                                const Eigen::MatrixXd& mass, const Eigen::MatrixXd& force,
                                const NewmarkOptions& options) {
  const Eigen::Index m = stiffness.rows(), steps = force.cols() - 1;
  ReducedMotion out;
  out.d = out.v = out.a = Eigen::MatrixXd::Zero(m, steps + 1);
  if (m == 0) return out;
  const double h = options.dt_s, beta = options.beta, gamma = options.gamma;
  // In acceleration form, each step takes only one dense product besides the inverse:
  //   (M + gamma h C + beta h^2 K) a1 = f1 - C v* - K d*,
  //   d* = d + h v + h^2 (1/2 - beta) a,  v* = v + h (1 - gamma) a.
  // In the coordinates in which K and M are diagonal, the cost of K d* is negligible.
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(mass, stiffness);
  const Eigen::MatrixXd& q = modes.eigenvectors();  // q^T K q = 1, q^T M q = lambda
  const Eigen::VectorXd lambda = modes.eigenvalues().cwiseMax(0);
  const Eigen::MatrixXd c = q.transpose() * damping * q;
  const Eigen::MatrixXd f = q.transpose() * force;
  Eigen::MatrixXd effective = gamma * h * c;
  effective.diagonal() += lambda;
  effective.diagonal().array() += beta * h * h;
  const Eigen::MatrixXd inverse = effective.llt().solve(Eigen::MatrixXd::Identity(m, m));

  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(m, steps + 1), v = d, a = d;
  // Modes whose mass is only rounding follow their forces without delay. Their acceleration is
  // undetermined and set to 0.
  const double massless = 1e-13 * lambda.maxCoeff();
  for (Eigen::Index i = 0; i < m; ++i)
    if (lambda[i] > massless) a(i, 0) = f(i, 0) / lambda[i];
  Eigen::VectorXd d_pre(m), v_pre(m), rest(m);
  for (Eigen::Index t = 0; t < steps; ++t) {
    d_pre = d.col(t) + h * v.col(t) + h * h * (0.5 - beta) * a.col(t);
    v_pre = v.col(t) + h * (1 - gamma) * a.col(t);
    rest = f.col(t + 1) - d_pre;
    rest.noalias() -= c * v_pre;
    a.col(t + 1).noalias() = inverse * rest;
    d.col(t + 1) = d_pre + beta * h * h * a.col(t + 1);
    v.col(t + 1) = v_pre + gamma * h * a.col(t + 1);
  }
  out.d = q * d;
  out.v = q * v;
  out.a = q * a;
  return out;
}

}  // namespace hyperex::fem
