// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/node_order.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "hyperex/fem/time/newmark.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

struct Box {
  test::BoxMesh box;
  System system;
  std::vector<int> held;

  explicit Box(int cells, double poisson = 0.495)
      : box(test::box_mesh({2 * cells, 2 * cells, cells}, Vec3(0.08, 0.08, 0.04), 0.1)),
        system(assemble(box.nodes, box.tets,
                        test::uniform_material(box.tets.rows(), 192.4e3, poisson, 476.8, 1100),
                        ElementKind::tet4_star)),
        held(test::unknowns_where(box.nodes, [](const Vec3& p) { return p.z() < 1e-9; })) {
    // One axis of some node alone too.
    held.push_back(static_cast<int>(system.stiffness.cols()) - 2);
  }
  Partition partition() const { return {static_cast<int>(system.stiffness.cols()), held}; }
};

Eigen::MatrixXd random_columns(Eigen::Index rows, int count) {
  Eigen::MatrixXd b(rows, count);
  for (int c = 0; c < count; ++c) b.col(c) = test::random_vector(rows, 7U + c);
  return b;
}

double worst_relative(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return ((a - b).colwise().norm().array() / b.colwise().norm().array()).maxCoeff();
}

TEST(Iterative, EqualsCholeskyOnABoxInManySubdomainsAndAfterOtherValues) {
  Box b(7);
  const Partition partition = b.partition();
  IterativeOptions options;
  options.subdomain_nodes = 150;
  IterativeSolver solver(b.system.stiffness, partition, b.box.nodes, "test", options);
  ASSERT_GT(solver.subdomain_count(), 8);
  const Eigen::MatrixXd rhs = random_columns(static_cast<Eigen::Index>(partition.free.size()), 19);
  for (const SparseMatrix& a : {b.system.stiffness, combined(b.system, 1e3, 1e6)}) {
    const SparseMatrix lower = free_lower(a, partition);
    Cholesky cholesky(lower, "test");
    ASSERT_EQ(cholesky.factorize(lower), -1);
    ASSERT_EQ(solver.factorize(a), -1);
    Eigen::MatrixXd expected = rhs, x = rhs;
    cholesky.solve(expected);
    solver.solve(x);
    EXPECT_LT(worst_relative(x, expected), 1e-8);
    EXPECT_GT(solver.last_iterations(), 3);
  }
}

TEST(Iterative, EqualsCholeskyOnTheFace) {
  const auto face = anatomy::embedded_face();
  const auto mesh = tissue::build_tissue_mesh(face.mesh, face.landmarks, {}, "embedded").volume;
  const System system = assemble(
      mesh.nodes, mesh.tets, test::uniform_material(mesh.tets.rows(), 192.4e3, 0.495, 476.8, 1100),
      ElementKind::tet4_star);
  // A third of the inner nodes is bonded.
  std::vector<int> held;
  for (int n = 0; n < static_cast<int>(mesh.surface_nodes()); n += 3)
    for (int axis = 0; axis < 3; ++axis)
      held.push_back(3 * (n + static_cast<int>(mesh.layers * mesh.surface_nodes())) + axis);
  PartitionedFactor direct(system.stiffness, held, "test", system.nodes, LinearSolver::cholesky);
  PartitionedFactor iterative(system.stiffness, held, "test", system.nodes,
                              LinearSolver::iterative);
  EXPECT_EQ(direct.solver(), LinearSolver::cholesky);
  EXPECT_EQ(iterative.solver(), LinearSolver::iterative);
  const Eigen::VectorXd rhs =
      test::random_vector(static_cast<Eigen::Index>(direct.free().size()), 3);
  Eigen::VectorXd expected = rhs, x = rhs;
  direct.solve(expected);
  iterative.solve(x);
  EXPECT_LT(worst_relative(x, expected), 1e-8);
  EXPECT_GT(iterative.last_iterations(), 3);
  EXPECT_LT(iterative.last_iterations(), 100);
  // A guess at the solution leaves nothing to do.
  x = rhs;
  iterative.solve(x, expected);
  EXPECT_LE(iterative.last_iterations(), 3);
  EXPECT_LT(worst_relative(x, expected), 1e-8);
}

TEST(Iterative, SeveralRightHandSidesEqualOneByOneAndZeroStaysZero) {
  Box b(5);
  const Partition partition = b.partition();
  IterativeSolver solver(b.system.stiffness, partition, b.box.nodes, "test", {1e-10, 200, 100});
  ASSERT_EQ(solver.factorize(b.system.stiffness), -1);
  Eigen::MatrixXd rhs = random_columns(static_cast<Eigen::Index>(partition.free.size()), 5);
  rhs.col(2).setZero();
  rhs.col(3) *= 1e-9;
  Eigen::MatrixXd together = rhs;
  solver.solve(together);
  EXPECT_EQ(together.col(2).norm(), 0);
  for (int c = 0; c < 5; ++c) {
    Eigen::MatrixXd one = rhs.col(c);
    solver.solve(one);
    EXPECT_LE((together.col(c) - one).norm(), 1e-9 * one.norm());
  }
}

TEST(Iterative, DoesNotDependOnTheThreads) {
  const Box b(5);
  const Partition partition = b.partition();
  const Eigen::MatrixXd rhs = random_columns(static_cast<Eigen::Index>(partition.free.size()), 3);
  std::vector<Eigen::MatrixXd> found;
  for (const std::size_t threads : {1U, 2U, 2U}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    IterativeSolver solver(b.system.stiffness, partition, b.box.nodes, "test", {1e-10, 200, 100});
    ASSERT_EQ(solver.factorize(b.system.stiffness), -1);
    found.push_back(rhs);
    solver.solve(found.back());
  }
  EXPECT_EQ((found[0] - found[1]).cwiseAbs().maxCoeff(), 0);
  EXPECT_EQ((found[1] - found[2]).cwiseAbs().maxCoeff(), 0);
}

TEST(Iterative, IterationsStayBoundedAsTheMeshIsRefined) {
  std::vector<int> iterations, subdomains;
  for (const int cells : {4, 6, 9}) {
    const Box b(cells);
    const Partition partition = b.partition();
    IterativeSolver solver(b.system.stiffness, partition, b.box.nodes, "test", {1e-10, 300, 120});
    ASSERT_EQ(solver.factorize(b.system.stiffness), -1);
    Eigen::MatrixXd x = random_columns(static_cast<Eigen::Index>(partition.free.size()), 1);
    solver.solve(x);
    iterations.push_back(solver.last_iterations());
    subdomains.push_back(solver.subdomain_count());
  }
  EXPECT_GT(subdomains[2], 6 * subdomains[0]);
  EXPECT_LT(iterations[2], 3 * iterations[0]);
  EXPECT_LT(iterations[2], 80);
}

TEST(Iterative, StopsInOneLine) {
  const Box b(5);
  const Partition partition = b.partition();
  IterativeSolver solver(b.system.stiffness, partition, b.box.nodes, "static solution",
                         {1e-10, 3, 100});
  ASSERT_EQ(solver.factorize(b.system.stiffness), -1);
  Eigen::MatrixXd x = random_columns(static_cast<Eigen::Index>(partition.free.size()), 1);
  try {
    solver.solve(x);
    FAIL();
  } catch (const NumericalError& e) {
    EXPECT_THAT(e.what(),
                testing::StartsWith("static solution: conjugate gradients did not reach"));
    EXPECT_THAT(e.what(), testing::Not(testing::HasSubstr("\n")));
  }
}

TEST(Iterative, RefusesALooseBody) {
  const Box b(6);
  for (const std::vector<int>& few : {std::vector<int>{}, {0, 1, 2}, {0, 1, 2, 3, 4, 5}}) try {
      const PartitionedFactor factor(b.system.stiffness, few, "test", b.box.nodes,
                                     LinearSolver::iterative);
      FAIL() << few.size();
    } catch (const NumericalError& e) {
      EXPECT_THAT(e.what(), testing::HasSubstr("too few supports"));
    }
}

TEST(Iterative, StepsLikeTheDirectSolver) {
  Box b(5);
  Newmark direct(b.system, b.held, {}, LinearSolver::cholesky);
  Newmark iterative(b.system, b.held, {}, LinearSolver::iterative);
  EXPECT_EQ(iterative.solver(), LinearSolver::iterative);
  const Eigen::VectorXd force = test::random_vector(b.system.mass.cols(), 5);
  const Eigen::VectorXd still = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(b.held.size()));
  for (int step = 1; step <= 20; ++step) {
    direct.step(still, std::min(1.0, 0.1 * step) * force);
    iterative.step(still, std::min(1.0, 0.1 * step) * force);
  }
  EXPECT_GT(iterative.last_iterations(), 0);
  EXPECT_EQ(direct.last_iterations(), 0);
  EXPECT_LT(worst_relative(iterative.displacement(), direct.displacement()), 1e-7);
}

TEST(NodeOrder, IsAnOrderAndForecastsTheFactor) {
  const Box b(8);
  const Partition partition = b.partition();
  const SparseMatrix lower = free_lower(b.system.stiffness, partition);
  std::vector<int> node_of;
  for (const int f : partition.free) node_of.push_back(f / 3);
  const NodeOrder order = order_by_nodes(lower, node_of);
  std::vector<int> sorted = order.unknowns;
  std::sort(sorted.begin(), sorted.end());
  for (int k = 0; k < static_cast<int>(sorted.size()); ++k) ASSERT_EQ(sorted[k], k);
  ASSERT_EQ(static_cast<Eigen::Index>(sorted.size()), lower.cols());
  const Cholesky cholesky(lower, "test", order.unknowns);
  EXPECT_NEAR(order.entries / cholesky.entries_needed(), 1, 0.05);
  EXPECT_NEAR(order.flops / cholesky.flops(), 1, 0.05);
  // Small meshes store more zeros than the share for large ones says.
  EXPECT_LT(cholesky.entries(), 1.1 * kStoredShare * order.entries);
  EXPECT_TRUE(order_by_nodes(SparseMatrix(0, 0), {}).unknowns.empty());
}

TEST(NodeOrder, OfFewerUnknownsKeepsTheOrderAndTakesNoLargerFactor) {
  const Box b(8);
  const Partition whole = b.partition();
  std::vector<int> more = whole.prescribed;
  for (int k = 0; k < int(whole.free.size()); k += 5) more.push_back(whole.free[k]);
  std::sort(more.begin(), more.end());
  const Partition part(whole.unknowns(), more);
  std::vector<int> node_of;
  for (const int f : whole.free) node_of.push_back(f / 3);
  const NodeOrder order = order_by_nodes(free_lower(b.system.stiffness, whole), node_of);
  const NodeOrder fewer = restricted(order, whole.unknowns(), whole.prescribed, more);
  ASSERT_EQ(fewer.unknowns.size(), part.free.size());
  std::vector<int> from_whole, from_part;
  for (const int k : order.unknowns)
    if (part.free_index[whole.free[k]] >= 0) from_whole.push_back(whole.free[k]);
  for (const int k : fewer.unknowns) from_part.push_back(part.free[k]);
  EXPECT_EQ(from_whole, from_part);
  const SparseMatrix lower = free_lower(b.system.stiffness, part);
  EXPECT_LE(
      Cholesky(lower, "test", fewer.unknowns).entries_needed(),
      Cholesky(free_lower(b.system.stiffness, whole), "test", order.unknowns).entries_needed());
}

TEST(PickLinearSolver, GoesByMemoryAndByWhatCholmodCanCount) {
  using enum LinearSolver;
  const double gib = 1ULL << 30U;
  const FactorForecast small{4e6, 1e9, 1e5}, large{1e9, 5e12, 1e7}, huge{2e9, 1e13, 1e8};
  EXPECT_EQ(pick_linear_solver(automatic, small, 1 * gib), cholesky);
  EXPECT_EQ(pick_linear_solver(automatic, small, 0.01 * gib), iterative);
  EXPECT_EQ(pick_linear_solver(automatic, large, 9 * gib), iterative);
  EXPECT_EQ(pick_linear_solver(automatic, large, 64 * gib), cholesky);
  // More than 2^31 entries cannot be counted, however much memory there is and whoever asks.
  EXPECT_EQ(pick_linear_solver(automatic, huge, 1000 * gib), iterative);
  EXPECT_EQ(pick_linear_solver(cholesky, huge, 1000 * gib), iterative);
  EXPECT_EQ(pick_linear_solver(cholesky, large, 1 * gib), cholesky);
  EXPECT_EQ(pick_linear_solver(iterative, small, 64 * gib), iterative);
  // Exactly at the share.
  const double wanted = 8 * kStoredShare * (1 + kStackShare) * 4e6 + kWorkspaceBytes * 1e5;
  EXPECT_EQ(pick_linear_solver(automatic, small, 1.001 * wanted / kFactorShare), cholesky);
  EXPECT_EQ(pick_linear_solver(automatic, small, 0.999 * wanted / kFactorShare), iterative);
}

TEST(PickLinearSolver, FindsTheMemoryOfThisMachine) {
  EXPECT_GT(available_memory_bytes(), 1e6);
  EXPECT_LT(available_memory_bytes(), 1e14);
}

}  // namespace
}  // namespace hyperex::fem
