// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/cholesky.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>

#include "hyperex/fem/solve/partition.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

/// Separate bodies of random sizes (1 x 1 blocks, paths, full blocks, and random graphs) whose
/// unknowns are mixed at random. Both triangles are stored.
SparseMatrix random_bodies(int bodies, int most_unknowns, unsigned seed) {
  std::mt19937 random(seed);
  const auto share = [&] { return random() / static_cast<double>(std::mt19937::max()); };
  std::vector<std::pair<int, int>> edges;
  int n = 0;
  for (int b = 0; b < bodies; ++b) {
    const int size = 1 + static_cast<int>(share() * most_unknowns);
    const int kind = static_cast<int>(random() % 3);
    for (int i = 1; i < size; ++i) {
      if (kind == 0) edges.push_back({n + i, n + i - 1});
      if (kind == 1)
        for (int j = 0; j < i && size <= 40; ++j) edges.push_back({n + i, n + j});
      if (kind == 2)
        for (int k = 0; k < 3; ++k)
          edges.push_back({n + i, n + std::max(0, i - 1 - static_cast<int>(share() * 20))});
    }
    n += size;
  }
  std::vector<int> place(n);
  for (int i = 0; i < n; ++i) place[i] = i;
  std::shuffle(place.begin(), place.end(), random);
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) entries.push_back({i, i, 0.1 + share()});
  for (const auto& [i, j] : edges) {
    const double w = 0.1 + share();
    entries.push_back({place[i], place[i], w});
    entries.push_back({place[j], place[j], w});
    entries.push_back({place[i], place[j], -w});
    entries.push_back({place[j], place[i], -w});
  }
  SparseMatrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

SparseMatrix lower_of(const SparseMatrix& a) {
  SparseMatrix lower = a.triangularView<Eigen::Lower>();
  lower.makeCompressed();
  return lower;
}

/// Compares both ways of solving with a dense factorisation.
void expect_solves(Cholesky& cholesky, const SparseMatrix& a) {
  const Eigen::LLT<Eigen::MatrixXd> dense{Eigen::MatrixXd(a)};
  ASSERT_EQ(cholesky.size(), a.cols());
  Eigen::MatrixXd wide(a.cols(), 0);
  for (const int columns : {1, 7, 2}) {
    Eigen::MatrixXd right(a.cols(), columns);
    for (int c = 0; c < columns; ++c) right.col(c) = test::random_vector(a.cols(), 10 + c);
    const Eigen::MatrixXd expected = dense.solve(right);
    Eigen::MatrixXd together = right;
    cholesky.solve(together);
    EXPECT_LT((together - expected).norm(), 1e-10 * expected.norm()) << columns << " together";
    for (int c = 0; c < columns; ++c) {
      Eigen::VectorXd one = right.col(c);
      cholesky.solve(one);
      EXPECT_LT((one - expected.col(c)).norm(), 1e-10 * expected.col(c).norm()) << "one";
    }
  }
  cholesky.solve(wide);  // nothing to do
}

TEST(Cholesky, EqualsADenseSolutionOnBodiesThatAreNotJoined) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const SparseMatrix a = random_bodies(1 + static_cast<int>(seed % 6) * 4, 150, seed);
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", " << a.cols() << " unknowns");
    Cholesky cholesky(lower_of(a), "test");
    ASSERT_EQ(cholesky.factorize(lower_of(a)), -1);
    expect_solves(cholesky, a);
    EXPECT_GE(cholesky.entries(), cholesky.entries_needed());
    EXPECT_GE(cholesky.entries_needed(), a.cols());
    EXPECT_GT(cholesky.flops(), 0);
  }
}

TEST(Cholesky, EqualsADenseSolutionOnTissue) {
  for (const ElementKind kind : kElementKinds) {
    const auto box = test::box_mesh({7, 6, 2}, Vec3(0.07, 0.06, 0.01), 0.1);
    const System s = assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), kind);
    const Partition p(static_cast<int>(s.mass.cols()),
                      test::unknowns_where(box.nodes, [](const Vec3& x) { return x.z() < 1e-9; }));
    const SparseMatrix lower = free_lower(combined(s, 1000, 1e6), p);
    Cholesky cholesky(lower, "test");
    ASSERT_EQ(cholesky.factorize(lower), -1);
    expect_solves(cholesky, lower.selfadjointView<Eigen::Lower>());
  }
}

TEST(Cholesky, TakesTheSmallestSystemsAndOneSupernode) {
  for (const int n : {1, 2, 3, 30}) {
    SCOPED_TRACE(n);
    const Eigen::MatrixXd b = Eigen::MatrixXd::Random(n, n);
    const Eigen::MatrixXd full = b * b.transpose() + n * Eigen::MatrixXd::Identity(n, n);
    const Eigen::MatrixXd diagonal = full.diagonal().asDiagonal();
    for (const Eigen::MatrixXd& dense : {full, diagonal}) {
      const SparseMatrix a = dense.sparseView();
      Cholesky cholesky(lower_of(a), "test");
      ASSERT_EQ(cholesky.factorize(lower_of(a)), -1);
      expect_solves(cholesky, a);
    }
  }
  Cholesky none(SparseMatrix(0, 0), "test");
  EXPECT_EQ(none.factorize(SparseMatrix(0, 0)), -1);
  Eigen::VectorXd x(0);
  none.solve(x);
  EXPECT_EQ(none.size(), 0);
}

TEST(Cholesky, GivesTheSameNumbersOnEachRunAndOnAnyNumberOfThreads) {
  const SparseMatrix a = random_bodies(3, 900, 5), lower = lower_of(a);
  const Eigen::VectorXd right = test::random_vector(a.cols(), 1);
  const auto solution = [&](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    Cholesky cholesky(lower, "test");
    cholesky.factorize(lower);
    Eigen::VectorXd x = right;
    cholesky.solve(x);
    return x;
  };
  const Eigen::VectorXd first = solution(1);
  for (const std::size_t threads : {1, 2, 4})
    for (int run = 0; run < 3; ++run) EXPECT_EQ((solution(threads) - first).norm(), 0);
}

TEST(Cholesky, FactorsOtherValuesOnTheSamePattern) {
  const SparseMatrix a = random_bodies(4, 200, 3);
  Cholesky cholesky(lower_of(a), "test");
  for (unsigned seed = 1; seed <= 3; ++seed) {
    // D A D is positive definite with A.
    const Eigen::VectorXd scale = test::random_vector(a.cols(), seed).array() + 2;
    const SparseMatrix other = scale.asDiagonal() * a * scale.asDiagonal();
    ASSERT_EQ(cholesky.factorize(lower_of(other)), -1);
    expect_solves(cholesky, other);
    Cholesky fresh(lower_of(other), "test");
    fresh.factorize(lower_of(other));
    Eigen::VectorXd x = scale, y = scale;
    cholesky.solve(x);
    fresh.solve(y);
    EXPECT_EQ((x - y).norm(), 0);
  }
}

TEST(Cholesky, NamesAColumnThatIsNotPositiveDefiniteAndRecovers) {
  const SparseMatrix good = random_bodies(3, 60, 8);
  const auto n = static_cast<int>(good.cols());
  for (const double bad : {-1.0, 0.0}) {
    for (const int at : {0, n / 2, n}) {
      // One unknown more, joined to nothing, put in at `at`.
      Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(n + 1, n + 1);
      std::vector<int> rest = test::complement(n + 1, {at});
      dense(rest, rest) = Eigen::MatrixXd(good);
      dense(at, at) = 1;
      SparseMatrix a = dense.sparseView();
      Cholesky cholesky(lower_of(a), "test");
      SparseMatrix spoilt = a;
      spoilt.coeffRef(at, at) = bad;
      EXPECT_EQ(cholesky.factorize(lower_of(spoilt)), at) << bad;
      // The first factorisation having failed, the next must still prepare all that solving needs.
      ASSERT_EQ(cholesky.factorize(lower_of(a)), -1);
      expect_solves(cholesky, a);
      EXPECT_EQ(cholesky.factorize(lower_of(spoilt)), at) << "and once more";
    }
  }
}

TEST(Cholesky, SeesABodyThatNothingHolds) {
  const auto box = test::box_mesh({3, 2, 2}, Vec3(0.03, 0.02, 0.02), 0.1);
  const auto shared = static_cast<int>(box.nodes.rows());
  Points nodes(2 * shared, 3);
  nodes << box.nodes, box.nodes.rowwise() + Eigen::RowVector3d(1, 0, 0);
  Tetrahedra tets(2 * box.tets.rows(), 4);
  tets << box.tets, box.tets.array() + shared;
  const System s = assemble(nodes, tets, test::varied_material(tets.rows()), ElementKind::tet4);
  // The first is held, the second is not.
  const Partition p(6 * shared,
                    test::unknowns_where(nodes, [](const Vec3& x) { return x.x() < 1e-9; }));
  const SparseMatrix lower = free_lower(s.stiffness, p);
  Cholesky cholesky(lower, "test");
  const int column = cholesky.factorize(lower);
  ASSERT_GE(column, 0);
  EXPECT_GE(p.free[column], 3 * shared);
}

}  // namespace
}  // namespace hyperex::fem
