// SPDX-License-Identifier: GPL-3.0-or-later
// Tissue moved by driven nodes: the partitioned sparse integrator is compared with a dense one; the
// order of convergence is checked with and without the motion's derivatives given.
#include <gtest/gtest.h>

#include "hyperex/fem/time/newmark.hpp"
#include "support/dense_newmark.hpp"
#include "support/spline_course.hpp"

namespace hyperex::fem {
namespace {

TEST(DrivenMotion, EqualsADenseReference) {
  const auto box = test::box_mesh({4, 2, 2}, Vec3(0.04, 0.02, 0.02), 0.15);
  const System s =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  const auto prescribed = test::unknowns_where(
      box.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > 0.04 - 1e-9; });
  const double dt_s = 2e-3;
  Newmark newmark(s, prescribed, {dt_s});
  test::DenseNewmark dense(s, prescribed, {dt_s});

  // One end is held, the other moves as in a mouth opening; a force acts on everything from step 20
  // on.
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
  // A rounding error in d is multiplied by 2/dt in v and by 4/dt^2 in a, and without damping it
  // stays there.
  EXPECT_LT(d_worst, 1e-10);
  EXPECT_LT(v_worst, 1e-8);
  EXPECT_LT(a_worst, 1e-6);
}

TEST(DrivenMotion, CarriesThePredictedStatesOfASetStart) {
  const auto box = test::box_mesh({3, 2, 1}, Vec3(0.03, 0.02, 0.01), 0);
  const System s =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  const auto prescribed =
      test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; });
  Newmark newmark(s, prescribed, {1e-3});
  test::DenseNewmark dense(s, prescribed, {1e-3});
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

/// Tissue driven by a motion recorded at 30 Hz.
struct Recorded {
  const test::BoxMesh box = test::box_mesh({4, 2, 2}, Vec3(0.04, 0.02, 0.02), 0.15);
  const System system =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4_star);
  const std::vector<int> prescribed = test::unknowns_where(
      box.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > 0.04 - 1e-9; });
  static constexpr int kKnots = 12;
  const std::vector<test::SplineCourse> courses = {test::SplineCourse::random(1.0 / 30, kKnots, 1),
                                                   test::SplineCourse::random(1.0 / 30, kKnots, 2)};

  struct Course {
    std::vector<Kinematics> at_knots;  // states of all unknowns
  };
  Course run(int steps_a_knot, bool displacement_alone) const {
    Drive drive;
    drive.prescribed.resize(static_cast<Eigen::Index>(prescribed.size()), 2);
    for (int r = 0; r < 2; ++r)
      drive.prescribed.col(r) = 2e-3 * test::random_vector(drive.prescribed.rows(), 7 + r);
    const double dt_s = 1.0 / 30 / steps_a_knot;
    test::set_courses(courses, dt_s, kKnots * steps_a_knot, drive);
    Newmark newmark(system, prescribed, {dt_s});
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(system.mass.cols());
    newmark.start(zero, zero, drive.prescribed_at(0).a);
    Course course;
    for (int i = 1; i <= drive.steps(); ++i) {
      if (displacement_alone)
        newmark.step(drive.prescribed_at(i).d);
      else
        newmark.step(drive.prescribed_at(i));
      if (i % steps_a_knot == 0) course.at_knots.push_back(newmark.state());
    }
    return course;
  }
};

struct MotionErrors {
  double d, v, driven_a;
};

MotionErrors errors(const Recorded& recorded, const Recorded::Course& found,
                    const Recorded::Course& truth) {
  MotionErrors e{0, 0, 0};
  double d = 0, v = 0, a = 0;
  for (std::size_t k = 0; k < truth.at_knots.size(); ++k) {
    const Kinematics &x = found.at_knots[k], &y = truth.at_knots[k];
    e.d = std::max(e.d, (x.d - y.d).norm());
    e.v = std::max(e.v, (x.v - y.v).norm());
    e.driven_a = std::max(e.driven_a, (x.a - y.a)(recorded.prescribed).norm());
    d = std::max(d, y.d.norm());
    v = std::max(v, y.v.norm());
    a = std::max(a, y.a(recorded.prescribed).norm());
  }
  return {e.d / d, e.v / v, e.driven_a / a};
}

/// With all three derivatives given the order is two. From the displacement alone, Newmark's
/// formulas give an acceleration that does not converge. In average acceleration, the error of v in
/// one step, h^2/6 times the third derivative, changes sign in each following step; a accumulates
/// 4/h times that, with alternating sign. Where inertia is small compared with viscosity, the
/// displacement is not affected, since the velocity that acts on it is the mean over each step.
TEST(DrivenMotion, ConvergesWithOrderTwoWhereTheDerivativesAreGiven) {
  const Recorded recorded;
  const Recorded::Course truth = recorded.run(512, false);
  std::vector<MotionErrors> given, alone;
  for (const int steps : {8, 16, 32, 64}) {
    given.push_back(errors(recorded, recorded.run(steps, false), truth));
    alone.push_back(errors(recorded, recorded.run(steps, true), truth));
    std::printf(
        "%3d steps a frame: error of d %.2e, v %.2e; displacement alone: d %.2e, v %.2e, "
        "driven a %.2e\n",
        steps, given.back().d, given.back().v, alone.back().d, alone.back().v,
        alone.back().driven_a);
  }
  for (std::size_t i = 0; i + 1 < given.size(); ++i) {
    EXPECT_NEAR(std::log2(given[i].d / given[i + 1].d), 2, 0.15) << i;
    EXPECT_NEAR(std::log2(given[i].v / given[i + 1].v), 2, 0.2) << i;
    EXPECT_EQ(given[i].driven_a, 0);
  }
  for (std::size_t i = 0; i + 1 < given.size(); ++i) {
    EXPECT_GT(alone[i].driven_a, 0.1);
    EXPECT_NEAR(alone[i].driven_a / alone[i + 1].driven_a, 1, 0.05) << "does not converge";
    EXPECT_NEAR(std::log2(alone[i].d / alone[i + 1].d), 2, 0.2) << i;
  }
}

}  // namespace
}  // namespace hyperex::fem
