// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "hyperex/fem/time/newmark.hpp"
#include "support/fem_support.hpp"
#include "support/refusal.hpp"

namespace hyperex::fem {
namespace {

struct Fixture : testing::Test {
  test::BoxMesh box = test::box_mesh({6, 3, 2}, Vec3(0.06, 0.03, 0.02), 0.1);
  System system =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  std::vector<int> held =
      test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; });
};

using StaticSolve = Fixture;
using NewmarkSteps = Fixture;

TEST_F(StaticSolve, EqualsADenseSolutionWithForcesAndPrescribedValues) {
  const StaticSolver solver(system.stiffness, held);
  const Eigen::MatrixXd k(system.stiffness);
  const auto free = test::complement(k.rows(), held);
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const Eigen::VectorXd force = test::random_vector(k.rows(), seed);
    const Eigen::VectorXd given =
        1e-3 * test::random_vector(static_cast<Eigen::Index>(held.size()), seed + 10);
    const Eigen::VectorXd rhs = force(free) - k(free, held) * given;
    const Eigen::VectorXd dense = k(free, free).ldlt().solve(rhs);
    const Eigen::VectorXd all = solver.solve(given, force);
    EXPECT_LT((all(free) - dense).norm(), 1e-9 * dense.norm());
    EXPECT_EQ((all(held) - given).norm(), 0);
  }
  EXPECT_EQ(solver.solve(Eigen::VectorXd::Zero(static_cast<Eigen::Index>(held.size()))).norm(), 0);
}

TEST_F(StaticSolve, RefusesTooFewSupportsWhateverTheScale) {
  for (const double scale : {1e-6, 1.0, 1e6}) {
    const SparseMatrix k = scale * system.stiffness;
    for (const std::vector<int>& few :
         {std::vector<int>{}, {0, 1, 2}, {0, 1, 2, 3, 4, 5}, {0, 3, 6, 9, 12, 15}})
      EXPECT_THAT(test::refusal<NumericalError>([&] { StaticSolver(k, few); }),
                  testing::HasSubstr("too few supports"))
          << few.size() << " supports, scale " << scale;
    EXPECT_NO_THROW(StaticSolver(k, held));
  }
}

TEST_F(StaticSolve, RefusesANodeThatNoElementUses) {
  Points nodes = box.nodes;
  nodes.conservativeResize(nodes.rows() + 1, 3);
  nodes.bottomRows(1).setZero();
  const System s =
      assemble(nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  EXPECT_THROW(StaticSolver(s.stiffness, held), NumericalError);
}

TEST(StaticSolveScale, TakesALongSlenderBar) {
  const auto box = test::box_mesh({150, 1, 1}, Vec3(1.5, 0.01, 0.01));
  const System s =
      assemble(box.nodes, box.tets,
               test::uniform_material(box.tets.rows(), 192.4e3, 0.495, 0, 1100), ElementKind::tet4);
  EXPECT_NO_THROW(StaticSolver(
      s.stiffness, test::unknowns_where(box.nodes, [](const Vec3& p) { return p.x() < 1e-9; })));
}

TEST_F(StaticSolve, TakesAllUnknownsPrescribed) {
  const StaticSolver solver(system.stiffness, test::complement(system.stiffness.cols(), {}));
  const Eigen::VectorXd given = test::random_vector(system.stiffness.cols(), 3);
  EXPECT_EQ((solver.solve(given) - given).norm(), 0);
}

TEST_F(NewmarkSteps, SettlesOnTheStaticSolution) {
  Newmark newmark(system, held, {5e-3});
  EXPECT_EQ(newmark.free_count(), system.mass.cols() - static_cast<int>(held.size()));
  const Eigen::VectorXd given =
      1e-4 * test::random_vector(static_cast<Eigen::Index>(held.size()), 4);
  const Eigen::VectorXd force = 1e-3 * test::random_vector(system.mass.cols(), 5);
  const Eigen::VectorXd expected = StaticSolver(system.stiffness, held).solve(given, force);
  // Average acceleration does not damp what swells without shearing, so the load comes on smoothly.
  const int ramp = 400;
  for (int i = 1; i <= 2500; ++i) {
    const double s = std::min(1.0, static_cast<double>(i) / ramp);
    const double share = s * s * s * (10 - 15 * s + 6 * s * s);
    newmark.step(share * given, share * force);
  }
  EXPECT_LT((newmark.displacement() - expected).norm(), 1e-4 * expected.norm());
}

TEST_F(NewmarkSteps, StandsStillWithoutInputAndGivesTheSameNumbersOnEachRun) {
  Newmark still(system, held, {2e-3});
  const auto count = static_cast<Eigen::Index>(held.size());
  for (int i = 0; i < 5; ++i) still.step(Eigen::VectorXd::Zero(count));
  EXPECT_EQ(still.displacement().norm(), 0);

  const auto run = [&] {
    Newmark newmark(system, held, {2e-3});
    for (int i = 1; i <= 20; ++i) newmark.step(Eigen::VectorXd::Constant(count, 1e-4 * i));
    return newmark.displacement();
  };
  EXPECT_EQ((run() - run()).cwiseAbs().maxCoeff(), 0);
}

TEST_F(NewmarkSteps, RefusesANodeThatNoElementUses) {
  Points nodes = box.nodes;
  nodes.conservativeResize(nodes.rows() + 1, 3);
  nodes.bottomRows(1).setZero();
  const System s =
      assemble(nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
  EXPECT_THROW(Newmark(s, held, {2e-3}), NumericalError);
}

}  // namespace
}  // namespace hyperex::fem
