// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/time/newmark.hpp"

#include <gtest/gtest.h>

#include "support/conformance.hpp"
#include "support/dense_newmark.hpp"
#include "support/spline_course.hpp"

namespace hyperex::fem {
namespace {

const std::pair<double, double> kBetaGamma[] = {{0.25, 0.5}, {0.3025, 0.6}, {0.5, 0.7}, {1.0, 1.5}};

/// A distorted bar with every element kind and viscous form, held at one end, driven at the other.
class NewmarkOn : public test::Conformance {
 protected:
  const test::BoxMesh box_ = test::box_mesh({4, 2, 2}, Vec3(0.04, 0.02, 0.02), 0.15);
  const System system_ = assembled(box_, varied(box_));
  const std::vector<int> prescribed_ = test::unknowns_where(
      box_.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > 0.04 - 1e-9; });
  const Eigen::Index all_ = system_.mass.cols();
  const Eigen::Index driven_ = static_cast<Eigen::Index>(prescribed_.size());

  /// Smooth, from rest, with all three derivatives.
  Kinematics given(double t) const {
    static const auto first = test::SplineCourse::random(0.02, 12, 1);
    static const auto second = test::SplineCourse::random(0.03, 12, 2);
    const Eigen::MatrixX3d s = 2e-3 * test::random_vector(driven_, 1) * first.at(t).transpose() +
                               2e-3 * test::random_vector(driven_, 2) * second.at(t).transpose();
    return {s.col(0), s.col(1), s.col(2)};
  }
  Eigen::VectorXd force(double t) const {
    return 1e-2 * std::cos(30 * t) * test::random_vector(all_, 3);
  }
  static double apart(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    return (a - b).norm() / b.norm();
  }
};

TEST_P(NewmarkOn, FollowsAMotionGivenWithItsDerivativesAsADenseReference) {
  for (const auto& [beta, gamma] : kBetaGamma) {
    const NewmarkOptions options{2e-3, beta, gamma};
    Newmark newmark(system_, prescribed_, options);
    test::DenseNewmark dense(system_, prescribed_, options);
    Eigen::VectorXd d = 1e-3 * test::random_vector(all_, 5), v = 0.1 * test::random_vector(all_, 6);
    const Kinematics first = given(0.01);
    d(prescribed_) = first.d;
    v(prescribed_) = first.v;
    newmark.start(d, v, first.a, force(0));
    dense.start(d, v, first.a, force(0));
    EXPECT_LT(apart(newmark.acceleration(), dense.a), 1e-9) << "at the start";
    double d_worst = 0, v_worst = 0, a_worst = 0;
    for (int i = 1; i <= 60; ++i) {
      const double t = 0.01 + i * options.dt_s;
      const Eigen::VectorXd f = i < 30 ? force(t) : Eigen::VectorXd::Zero(all_);
      if (i < 30)
        newmark.step(given(t), f);
      else
        newmark.step(given(t));
      dense.step(given(t), f);
      d_worst = std::max(d_worst, apart(newmark.displacement(), dense.d));
      v_worst = std::max(v_worst, apart(newmark.velocity(), dense.v));
      a_worst = std::max(a_worst, apart(newmark.acceleration(), dense.a));
      EXPECT_EQ((newmark.velocity()(prescribed_) - given(t).v).norm(), 0);
      EXPECT_EQ((newmark.acceleration()(prescribed_) - given(t).a).norm(), 0);
    }
    EXPECT_LT(d_worst, 1e-10) << "beta " << beta;
    EXPECT_LT(v_worst, 1e-8) << "beta " << beta;
    EXPECT_LT(a_worst, 1e-6) << "beta " << beta;
  }
}

TEST_P(NewmarkOn, DisplacementAloneIsTheMotionOfNewmarksOwnFormulas) {
  for (const auto& [beta, gamma] : kBetaGamma) {
    const NewmarkOptions options{2e-3, beta, gamma};
    Newmark alone(system_, prescribed_, options), fed(system_, prescribed_, options);
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(all_);
    alone.start(zero, zero, given(0).a);
    fed.start(zero, zero, given(0).a);
    const double h = options.dt_s;
    for (int i = 1; i <= 40; ++i) {
      const Eigen::VectorXd d = given(i * h).d;
      const Eigen::VectorXd d0 = fed.displacement()(prescribed_), v0 = fed.velocity()(prescribed_),
                            a0 = fed.acceleration()(prescribed_);
      // d1 = d0 + h v0 + h^2 ((1/2 - beta) a0 + beta a1) solved for a1, then v1.
      const Eigen::VectorXd a1 = ((d - d0 - h * v0) / (h * h) - (0.5 - beta) * a0) / beta;
      const Eigen::VectorXd v1 = v0 + h * ((1 - gamma) * a0 + gamma * a1);
      alone.step(d, force(i * h));
      fed.step(Kinematics{d, v1, a1}, force(i * h));
      EXPECT_LT(apart(alone.displacement(), fed.displacement()), 1e-12);
      EXPECT_LT(apart(alone.velocity(), fed.velocity()), 1e-9);
      EXPECT_LT(apart(alone.acceleration(), fed.acceleration()), 1e-8);
    }
  }
}

TEST_P(NewmarkOn, StartsInEquilibrium) {
  Newmark newmark(system_, prescribed_, {2e-3});
  const auto free = test::complement(all_, prescribed_);
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(all_);
  const auto lacking = [&](const Eigen::VectorXd& f) {
    Eigen::VectorXd of_free = newmark.acceleration();
    of_free(prescribed_).setZero();
    of_free = (system_.mass * of_free).eval();
    const Eigen::VectorXd r = system_.mass * newmark.acceleration() +
                              system_.damping * newmark.velocity() +
                              system_.stiffness * newmark.displacement() - f;
    return r(free).norm() / of_free(free).norm();
  };
  const Eigen::VectorXd d = 1e-3 * test::random_vector(all_, 1), v = test::random_vector(all_, 2);
  const Eigen::VectorXd a = test::random_vector(driven_, 3), f = test::random_vector(all_, 4);
  newmark.start(d, v, a, f);
  EXPECT_LT(lacking(f), 1e-11);
  EXPECT_EQ(newmark.displacement(), d);
  EXPECT_EQ(newmark.velocity(), v);
  EXPECT_EQ((newmark.acceleration()(prescribed_) - a).norm(), 0);
  // Each cause alone.
  for (int cause = 0; cause < 4; ++cause) {
    newmark.start(cause == 0 ? d : zero, cause == 1 ? v : zero, cause == 2 ? a : 0 * a,
                  cause == 3 ? f : zero);
    EXPECT_GT(newmark.acceleration()(free).norm(), 0) << cause;
    EXPECT_LT(lacking(cause == 3 ? f : zero), 1e-11) << cause;
  }
  newmark.start(zero, zero, 0 * a);
  EXPECT_EQ(newmark.acceleration().norm(), 0);
}

/// From rest, under a motion that starts with an acceleration: the change of acceleration in step 1
/// vanishes with dt. From the start, the acceleration of the free nodes is of the size of that of
/// the driven ones.
TEST_P(NewmarkOn, DoesNotJumpAtTheFirstStep) {
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(all_);
  const auto free = test::complement(all_, prescribed_);
  std::vector<double> change;
  for (const double dt_s : {1e-6, 5e-7, 2.5e-7}) {
    Newmark newmark(system_, prescribed_, {dt_s});
    newmark.start(zero, zero, given(0).a);
    const Eigen::VectorXd before = newmark.acceleration()(free);
    newmark.step(given(dt_s));
    const Eigen::VectorXd after = newmark.acceleration()(free);
    change.push_back((after - before).norm() / before.norm());
  }
  EXPECT_LT(change[2], 0.05);
  EXPECT_NEAR(change[0] / change[1], 2, 0.2);
  EXPECT_NEAR(change[1] / change[2], 2, 0.1);
  // The same without an acceleration in equilibrium: it jumps, however small the step.
  Newmark careless(system_, prescribed_, {1e-6});
  careless.step(given(1e-6));
  const Eigen::VectorXd jump = careless.acceleration()(free);
  EXPECT_GT(jump.norm(), 0.5 * given(0).a.norm() / std::sqrt(double(driven_)));
}

TEST_P(NewmarkOn, RefilledIsAsNew) {
  Newmark kept(system_, prescribed_, {2e-3, 0.3025, 0.6});
  for (int i = 1; i <= 5; ++i) kept.step(given(i * 2e-3), force(0));
  Material material = test::varied_material(box_.tets.rows(), 99);
  material.viscous_form = GetParam().viscous_form;
  const System other = assembled(box_, material);
  kept.refill(other);
  EXPECT_EQ(kept.displacement().norm() + kept.velocity().norm() + kept.acceleration().norm(), 0);
  Newmark fresh(other, prescribed_, {2e-3, 0.3025, 0.6});
  const Eigen::VectorXd zero = Eigen::VectorXd::Zero(all_);
  for (Newmark* n : {&kept, &fresh}) {
    n->start(zero, zero, given(0).a, force(0));
    for (int i = 1; i <= 10; ++i) n->step(given(i * 2e-3), force(i * 2e-3));
  }
  EXPECT_EQ(kept.displacement(), fresh.displacement());
  EXPECT_EQ(kept.velocity(), fresh.velocity());
  EXPECT_EQ(kept.acceleration(), fresh.acceleration());
}

TEST_P(NewmarkOn, GammaAboveAHalfDampsWhatTheStepDoesNotResolve) {
  System lossless = system_;
  lossless.damping *= 0;
  const auto left = [&](double beta, double gamma) {
    Newmark newmark(lossless, prescribed_, {5e-3, beta, gamma});
    Eigen::VectorXd d = 1e-3 * test::random_vector(all_, 5), v = 0 * d;
    d(prescribed_).setZero();
    newmark.start(d, v, Eigen::VectorXd::Zero(driven_));
    const double before = d.dot(lossless.stiffness * d);
    for (int i = 0; i < 100; ++i) newmark.step(Eigen::VectorXd(Eigen::VectorXd::Zero(driven_)));
    return (newmark.displacement().dot(lossless.stiffness * newmark.displacement()) +
            newmark.velocity().dot(lossless.mass * newmark.velocity())) /
           before;
  };
  EXPECT_NEAR(left(0.25, 0.5), 1, 1e-8);
  EXPECT_LT(left(0.3025, 0.6), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Cases, NewmarkOn, testing::ValuesIn(test::all_cases()),
                         [](const auto& c) { return test::Case::name(c.param); });

}  // namespace
}  // namespace hyperex::fem
