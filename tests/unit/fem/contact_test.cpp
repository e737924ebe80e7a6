// SPDX-License-Identifier: GPL-3.0-or-later
// Complementarity, condensed compliance, and both together compared with closed forms of contact.
#include <gtest/gtest.h>

#include <random>

#include "hyperex/fem/solve/complementarity.hpp"
#include "hyperex/fem/solve/condensed_inverse.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

TEST(Complementarity, FindsTheSolutionThatItWasMadeFor) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  constexpr int n = 40;
  const Eigen::MatrixXd b = Eigen::MatrixXd::NullaryExpr(n, n, [&] { return unit(random) - 0.5; });
  const Eigen::MatrixXd a = b * b.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(n), w = z;
  for (int i = 0; i < n; ++i) (i % 3 ? z : w)[i] = 0.1 + unit(random);
  Eigen::VectorXd found = Eigen::VectorXd::Zero(n);
  const Complementarity how = solve_complementarity(a, w - a * z, 1e-12, 20000, found);
  EXPECT_LE(how.residual, 1e-12);
  EXPECT_LT((found - z).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_GE(found.minCoeff(), 0) << "no pair pulls";
}

TEST(Complementarity, DoesNothingWhereNothingTouches) {
  const Eigen::MatrixXd a = Eigen::MatrixXd::Identity(3, 3);
  Eigen::VectorXd z = Eigen::VectorXd::Zero(3);
  EXPECT_EQ(solve_complementarity(a, Eigen::Vector3d(1, 0, 2), 1e-12, 10, z).sweeps, 0);
  EXPECT_EQ(z.norm(), 0);
}

TEST(Complementarity, SweepsFindWhatTheActiveSetMisses) {
  Eigen::Matrix3d a;
  a << 4, 5, -5, 5, 9, -5, -5, -5, 7;
  const Eigen::Vector3d q(-2, -1, 3);  // sets {1, 2}, {1, 3}, {}, and so z = 0 again
  Eigen::VectorXd z = Eigen::VectorXd::Zero(3);
  const Complementarity how = solve_complementarity(a, q, 1e-12, 9, z);
  EXPECT_GT(how.sweeps, 0);
  EXPECT_LE(how.residual, 1e-12);
  EXPECT_LT((z - Eigen::Vector3d(0.5, 0, 0)).norm(), 1e-12);
}

TEST(Complementarity, TellsWhereItWasNotSolved) {
  Eigen::MatrixXd a(2, 2);
  a << 1, -1, -1, 1;  // no z makes both w >= 0
  Eigen::VectorXd z = Eigen::VectorXd::Zero(2);
  const Complementarity how = solve_complementarity(a, Eigen::Vector2d(-1, -1), 1e-9, 5, z);
  EXPECT_EQ(how.sweeps, 5);
  EXPECT_GT(how.residual, 0.5);
}

constexpr double kHeight = 0.01, kYoung = 20e3, kPoisson = 0.3;
/// Modulus of a layer that cannot deform sideways.
constexpr double kConfined = kYoung * (1 - kPoisson) / ((1 + kPoisson) * (1 - 2 * kPoisson));

/// A layer on a rigid base; nodes move along z alone.
struct Layer {
  test::BoxMesh box;
  SparseMatrix stiffness;
  std::vector<int> prescribed, top;

  Layer(std::array<int, 3> cells, const Vec3& size) : box(test::box_mesh(cells, size)) {
    stiffness = assemble(box.nodes, box.tets,
                         test::uniform_material(box.tets.rows(), kYoung, kPoisson, 0, 1000),
                         ElementKind::tet4)
                    .stiffness;
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n) {
      prescribed.push_back(int(3 * n));
      prescribed.push_back(int(3 * n + 1));
      if (box.nodes(n, 2) < 1e-9) prescribed.push_back(int(3 * n + 2));
      if (box.nodes(n, 2) > size.z() - 1e-9) top.push_back(int(n));
    }
  }
};

TEST(CondensedInverse, IsAPieceOfTheInverse) {
  const Layer layer({3, 2, 2}, {0.03, 0.02, kHeight});
  PartitionedFactor factor(layer.stiffness, layer.prescribed, "test");
  const std::vector<int> nodes{layer.top[4], layer.box.node(1, 1, 1), layer.box.node(0, 0, 0)};
  const Eigen::MatrixXd c = condensed_inverse(factor, nodes);
  const Eigen::MatrixXd whole =
      Eigen::MatrixXd(layer.stiffness)(factor.free(), factor.free()).inverse();
  const auto at = [&](int unknown) {
    return std::find(factor.free().begin(), factor.free().end(), unknown) - factor.free().begin();
  };
  ASSERT_EQ(c.rows(), 9);
  for (const int i : {0, 1})
    for (const int k : {0, 1})
      EXPECT_NEAR(c(3 * i + 2, 3 * k + 2),
                  whole(at(3 * nodes[std::size_t(i)] + 2), at(3 * nodes[std::size_t(k)] + 2)),
                  1e-9 * whole.cwiseAbs().maxCoeff());
  EXPECT_EQ(c.bottomRows<3>().norm(), 0) << "held";
  EXPECT_EQ(c.row(0).norm(), 0) << "held along x";
  EXPECT_EQ((c - c.transpose()).norm(), 0);
}

TEST(CondensedInverse, IsReadOffAFactorThatEliminatesItsNodesLast) {
  const Layer layer({4, 4, 3}, {0.03, 0.02, kHeight});
  PartitionedFactor known(layer.stiffness, layer.prescribed, "test");
  std::vector<int> nodes(layer.top.begin() + 3, layer.top.begin() + 12);
  nodes.push_back(layer.box.node(1, 2, 1));
  std::sort(nodes.begin(), nodes.end());
  std::vector<int> prescribed = layer.prescribed;  // fewer than the order was found for
  prescribed.erase(prescribed.begin() + 5);
  const auto unknowns = int(layer.stiffness.cols());
  auto order = std::make_shared<const NodeOrder>(
      order_with_last(*known.order(), layer.prescribed, prescribed, unknowns, nodes));
  PartitionedFactor last(layer.stiffness, prescribed, "test", order);
  PartitionedFactor any(layer.stiffness, prescribed, "test");
  std::vector<int> columns;
  for (const int node : nodes)
    for (int axis = 0; axis < 3; ++axis)
      if (const int at = last.partition().free_index[std::size_t(3 * node + axis)]; at >= 0)
        columns.push_back(at);
  EXPECT_EQ(last.cholesky().inverse_of_last(columns).rows(), Eigen::Index(columns.size()));
  EXPECT_EQ(any.cholesky().inverse_of_last(columns).rows(), 0) << "others are last there";
  const Eigen::MatrixXd read = condensed_inverse(last, nodes),
                        solved = condensed_inverse(any, nodes);
  EXPECT_LT((read - solved).cwiseAbs().maxCoeff(), 1e-10 * solved.cwiseAbs().maxCoeff());
  Eigen::MatrixXd force = Eigen::MatrixXd::Random(Eigen::Index(last.free().size()), 2),
                  twin = force;
  last.solve(force);
  any.solve(twin);
  EXPECT_LT((force - twin).cwiseAbs().maxCoeff(), 1e-10 * twin.cwiseAbs().maxCoeff());
}

/// Forces on the top of the layer from a rigid plane z = height - depth.
Eigen::VectorXd pressed(const Layer& layer, const std::function<double(const Vec3&)>& depth) {
  PartitionedFactor factor(layer.stiffness, layer.prescribed, "test");
  const Eigen::MatrixXd c = condensed_inverse(factor, layer.top);
  const auto n = Eigen::Index(layer.top.size());
  Eigen::VectorXd gap(n), force = Eigen::VectorXd::Zero(n);
  Eigen::MatrixXd along(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    gap[i] = -depth(layer.box.nodes.row(layer.top[std::size_t(i)]));
    for (Eigen::Index k = 0; k < n; ++k) along(i, k) = c(3 * i + 2, 3 * k + 2);
  }
  EXPECT_LE(solve_complementarity(along, gap, 1e-12, 20000, force).residual, 1e-12);
  return force;
}

TEST(Contact, AFlatPunchPressesAConfinedLayerAsTheClosedFormHasIt) {
  const Layer layer({4, 3, 3}, {0.02, 0.015, kHeight});
  constexpr double depth = 1e-3;
  const Eigen::VectorXd force = pressed(layer, [](const Vec3&) { return depth; });
  EXPECT_GT(force.minCoeff(), 0);
  EXPECT_NEAR(force.sum() / (0.02 * 0.015), kConfined * depth / kHeight, 1e-6 * kConfined);
}

/// In the limit H -> 0, a thin layer on a rigid base whose nodes move along z alone is a bed of
/// springs M / H (Johnson, Contact Mechanics, 1985, 5.8). A wedge d(x) = d0 (1 - x / a) then
/// presses with M d0 a / 2 H per unit of width.
TEST(Contact, AWedgeOnAThinLayerConverges) {
  constexpr double d0 = 1e-4, a = 0.0213, length = 0.04, width = 0.001;
  const auto error = [&](int cells) {
    const double height = length / cells;
    const Layer layer({cells, 1, 1}, {length, width, height});
    const Eigen::VectorXd force =
        pressed(layer, [&](const Vec3& p) { return d0 * (1 - p.x() / a); });
    const double exact = kConfined * d0 * a * width / (2 * height);
    return std::abs(force.sum() / exact - 1);
  };
  const double coarse = error(20), fine = error(40), finest = error(80);
  EXPECT_LT(fine, 0.6 * coarse);
  EXPECT_LT(finest, 0.6 * fine);
  EXPECT_LT(finest, 0.03);
}

}  // namespace
}  // namespace hyperex::fem
