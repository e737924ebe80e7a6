// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/muscles/bounded_least_squares.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace hyperex::muscles {
namespace {

constexpr double kNone = -std::numeric_limits<double>::infinity();

struct Problem {
  Eigen::MatrixXd h;
  Eigen::VectorXd g, lower;
};

/// With fewer rows than unknowns, a small prior makes the problem definite, as for activations.
Problem random_problem(std::mt19937& random, int n) {
  std::normal_distribution<double> normal;
  const auto matrix = [&](int rows, int cols) {
    return Eigen::MatrixXd(
        Eigen::MatrixXd::NullaryExpr(rows, cols, [&] { return normal(random); }));
  };
  const int rows = 1 + static_cast<int>(random() % (2 * n));
  const Eigen::MatrixXd a = matrix(rows, n);
  Problem p{a.transpose() * a + 0.05 * Eigen::MatrixXd::Identity(n, n), {}, {}};
  p.g = a.transpose() * matrix(rows, 1);
  p.lower = Eigen::VectorXd::NullaryExpr(n, [&] {
    const int kind = static_cast<int>(random() % 4);
    return kind == 0 ? kNone : kind == 1 ? -0.1 * static_cast<double>(random() % 5) : 0.0;
  });
  return p;
}

double value(const Problem& p, const Eigen::VectorXd& x) {
  return 0.5 * x.dot(p.h * x) - p.g.dot(x);
}

Eigen::VectorXd solved(const Problem& p, Eigen::VectorXd x) {
  bounded_least_squares(p.h, p.g, p.lower, x);
  return x;
}

/// The least value over all sets of entries held at their bounds.
Eigen::VectorXd by_brute_force(const Problem& p) {
  const int n = static_cast<int>(p.g.size());
  Eigen::VectorXd best;
  for (unsigned set = 0; set < 1u << n; ++set) {
    std::vector<int> free, held;
    bool bounded = true;
    for (int i = 0; i < n; ++i) {
      (set >> i & 1 ? held : free).push_back(i);
      if (set >> i & 1 && p.lower[i] == kNone) bounded = false;
    }
    if (!bounded) continue;
    Eigen::VectorXd x = Eigen::VectorXd::Zero(n);
    for (const int i : held) x[i] = p.lower[i];
    if (!free.empty()) {
      Eigen::VectorXd right = p.g(free);
      for (const int j : held) right -= p.h(free, j) * p.lower[j];
      const Eigen::MatrixXd of_free = p.h(free, free);
      const Eigen::VectorXd answer = of_free.ldlt().solve(right);
      x(free) = answer;
    }
    if ((x - p.lower).minCoeff() < -1e-12) continue;
    if (best.size() == 0 || value(p, x) < value(p, best)) best = x;
  }
  return best;
}

TEST(BoundedLeastSquares, MeetsTheConditionsOfOptimality) {
  std::mt19937 random(7);
  int at_bound = 0, off_bound = 0;
  for (int k = 0; k < 200; ++k) {
    const int n = 1 + static_cast<int>(random() % 60);
    const Problem p = random_problem(random, n);
    const Eigen::VectorXd x = solved(p, p.lower.cwiseMax(0));
    const Eigen::VectorXd slope = p.h * x - p.g;
    const double small = 1e-8 * (1 + p.g.cwiseAbs().maxCoeff());
    for (int i = 0; i < n; ++i) {
      ASSERT_GE(x[i], p.lower[i]) << k;
      if (x[i] == p.lower[i]) {
        ++at_bound;
        EXPECT_GE(slope[i], -small) << k;
      } else {
        ++off_bound;
        EXPECT_NEAR(slope[i], 0, small) << k;
      }
    }
  }
  EXPECT_GT(at_bound, 1000);
  EXPECT_GT(off_bound, 1000);
}

TEST(BoundedLeastSquares, IsTheLeastOverEverySetOfHeldEntries) {
  std::mt19937 random(11);
  for (int k = 0; k < 200; ++k) {
    const Problem p = random_problem(random, 1 + static_cast<int>(random() % 8));
    const Eigen::VectorXd wanted = by_brute_force(p);
    ASSERT_GT(wanted.size(), 0);
    EXPECT_LT((solved(p, p.lower.cwiseMax(0)) - wanted).cwiseAbs().maxCoeff(), 1e-8) << k;
  }
}

TEST(BoundedLeastSquares, WhereItStartsDoesNotMatter) {
  std::mt19937 random(13);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 100; ++k) {
    const int n = 1 + static_cast<int>(random() % 60);
    const Problem p = random_problem(random, n);
    const Eigen::VectorXd x = solved(p, p.lower.cwiseMax(0));
    const Eigen::VectorXd anywhere =
        Eigen::VectorXd::NullaryExpr(n, [&] { return 3 * normal(random); });
    EXPECT_LT((solved(p, anywhere) - x).cwiseAbs().maxCoeff(), 1e-8) << k;
    EXPECT_LT((solved(p, Eigen::VectorXd::Constant(n, 1e3)) - x).cwiseAbs().maxCoeff(), 1e-8) << k;
    EXPECT_EQ(solved(p, x), x) << "from the answer";
  }
}

TEST(BoundedLeastSquares, NothingToPullLeavesAllAtRest) {
  const Problem p{Eigen::MatrixXd::Identity(3, 3), Eigen::VectorXd::Zero(3),
                  Eigen::Vector3d(0, kNone, 0)};
  EXPECT_EQ(solved(p, Eigen::Vector3d(1, 2, 3)), Eigen::Vector3d::Zero());
}

}  // namespace
}  // namespace hyperex::muscles
