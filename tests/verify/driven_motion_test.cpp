// SPDX-License-Identifier: GPL-3.0-or-later
// Driven nodes pull tissue along: the partitioned sparse integrator against a dense one written
// another way round, which solves for the accelerations from predicted states.
#include <gtest/gtest.h>

#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

struct DenseNewmark {
  Eigen::MatrixXd m, c, k;
  std::vector<int> prescribed, free;
  double dt;
  Eigen::VectorXd d, v, a;

  DenseNewmark(const System& s, const std::vector<int>& prescribed_, double dt_)
      : m(s.mass),
        c(s.damping),
        k(s.stiffness),
        prescribed(prescribed_),
        free(test::complement(m.rows(), prescribed_)),
        dt(dt_) {
    d = v = a = Eigen::VectorXd::Zero(m.rows());
  }

  void step(const Eigen::VectorXd& given, const Eigen::VectorXd& force) {
    const Eigen::VectorXd d_pre = d + dt * v + dt * dt / 4 * a;
    const Eigen::VectorXd v_pre = v + dt / 2 * a;
    Eigen::VectorXd next = Eigen::VectorXd::Zero(d.size());
    next(prescribed) = 4 / (dt * dt) * (given - d_pre(prescribed));
    const Eigen::MatrixXd effective = m + dt / 2 * c + dt * dt / 4 * k;
    const Eigen::VectorXd residual = force - k * d_pre - c * v_pre - effective * next;
    const Eigen::MatrixXd among_free = effective(free, free);
    const Eigen::VectorXd residual_free = residual(free);
    next(free) = Eigen::VectorXd(among_free.partialPivLu().solve(residual_free));
    d = d_pre + dt * dt / 4 * next;
    v = v_pre + dt / 2 * next;
    a = next;
  }
};

TEST(DrivenMotion, EqualsADenseReference) {
  const auto box = test::box_mesh({4, 2, 2}, Vec3(0.04, 0.02, 0.02), 0.15);
  const System s = assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()));
  const auto prescribed = test::unknowns_where(
      box.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > 0.04 - 1e-9; });
  const double dt_s = 2e-3;
  Newmark newmark(s, prescribed, {dt_s});
  DenseNewmark dense(s, prescribed, dt_s);

  // One end is held, the other moves as a mouth opens; a force acts on everything from step 20 on.
  const Eigen::VectorXd way = test::random_vector(static_cast<Eigen::Index>(prescribed.size()), 3);
  const Eigen::VectorXd force = 1e-3 * test::random_vector(s.mass.rows(), 4);
  double d_worst = 0, v_worst = 0, a_worst = 0;
  for (int i = 1; i <= 100; ++i) {
    const double t = i * dt_s;
    Eigen::VectorXd given(way.size());
    for (Eigen::Index j = 0; j < given.size(); ++j)
      given[j] = box.nodes(prescribed[j] / 3, 0) < 1e-9
                     ? 0
                     : 5e-3 * way[j] * std::pow(std::sin(10 * t), 2);
    if (i < 20) {
      newmark.step(given);
      dense.step(given, Eigen::VectorXd::Zero(force.size()));
    } else {
      newmark.step(given, force);
      dense.step(given, force);
    }
    EXPECT_EQ((newmark.displacement()(prescribed) - given).norm(), 0);
    d_worst = std::max(d_worst, (newmark.displacement() - dense.d).norm() / dense.d.norm());
    v_worst = std::max(v_worst, (newmark.velocity() - dense.v).norm() / dense.v.norm());
    a_worst = std::max(a_worst, (newmark.acceleration() - dense.a).norm() / dense.a.norm());
  }
  // Rounding in d is multiplied by 2/dt and 4/dt^2 in v and a, and stays there without damping.
  EXPECT_LT(d_worst, 1e-10);
  EXPECT_LT(v_worst, 1e-8);
  EXPECT_LT(a_worst, 1e-6);
}

TEST(DrivenMotion, CarriesThePredictedStatesOfASetStart) {
  const auto box = test::box_mesh({3, 2, 1}, Vec3(0.03, 0.02, 0.01), 0);
  const System s = assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()));
  const auto prescribed =
      test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; });
  Newmark newmark(s, prescribed, {1e-3});
  DenseNewmark dense(s, prescribed, 1e-3);
  dense.d = 1e-3 * test::random_vector(s.mass.rows(), 1);
  dense.v = 1e-1 * test::random_vector(s.mass.rows(), 2);
  dense.a = 1e1 * test::random_vector(s.mass.rows(), 3);
  newmark.set_state(dense.d, dense.v, dense.a);
  for (int i = 1; i <= 10; ++i) {
    const Eigen::VectorXd given = dense.d(prescribed) + 1e-3 * dense.v(prescribed);
    newmark.step(given);
    dense.step(given, Eigen::VectorXd::Zero(s.mass.rows()));
  }
  EXPECT_LT((newmark.displacement() - dense.d).norm(), 1e-10 * dense.d.norm());
  EXPECT_LT((newmark.velocity() - dense.v).norm(), 1e-9 * dense.v.norm());
  EXPECT_LT((newmark.acceleration() - dense.a).norm(), 1e-8 * dense.a.norm());
}

}  // namespace
}  // namespace hyperex::fem
