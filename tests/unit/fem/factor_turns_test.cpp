// SPDX-License-Identifier: GPL-3.0-or-later
// An old factor, rotated with the tissue.
#include "hyperex/fem/time/factor_turns.hpp"

#include <gtest/gtest.h>

#include "hyperex/fem/form/node_rotation.hpp"
#include "hyperex/fem/time/finite_newton.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

using Eigen::VectorXd;

const Vec3 kBarSize{0.04, 0.03, 0.02};

Eigen::Matrix3d turn_about(const Vec3& axis, double angle_rad) {
  return Eigen::AngleAxisd(angle_rad, axis.normalized()).toRotationMatrix();
}

struct Bar {
  test::BoxMesh box = test::box_mesh({4, 3, 2}, kBarSize, 0.1);
  Assembler assembler{box.nodes, box.tets, ElementKind::tet4_star};

  /// Displacement of all unknowns by the linear map x -> a x.
  VectorXd mapped(const Eigen::Matrix3d& a) const {
    VectorXd d(box.nodes.size());
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n) {
      const Vec3 x = box.nodes.row(n).transpose();
      d.segment<3>(3 * n) = a * x - x;
    }
    return d;
  }
};

TEST(FactorTurns, TheRotationOfANodeIsThePolarFactor) {
  const Bar bar;
  const Eigen::Matrix3d turn = turn_about({1, 2, -1}, 0.9);
  Eigen::Matrix3d stretch;
  stretch << 1.3, 0.1, 0, 0.1, 0.8, 0.05, 0, 0.05, 1.1;
  const VectorXd d = bar.mapped(turn * stretch);
  for (const int node : {0, 7, int(bar.box.nodes.rows()) - 1})
    EXPECT_LT((node_rotation(bar.assembler, d, node, Eigen::Matrix3d::Identity()) - turn).norm(),
              1e-9);
  const VectorXd inverted = bar.mapped(Vec3(-1, 1, 1).asDiagonal());
  EXPECT_EQ(node_rotation(bar.assembler, inverted, 3, turn), turn);
}

TEST(FactorTurns, TurnsWholeNodesBySinceTheFactor) {
  const Bar bar;
  const Vec3 axis(0, 0.3, 1);
  FactorTurns turns(bar.assembler);
  const std::vector<int> unknowns = {0, 1, 2, 4, 5, 9, 10, 11};  // node 1 without its first axis
  VectorXd v = VectorXd::LinSpaced(8, 1, 8);
  const VectorXd before = v;
  turns.factored_at(bar.mapped(turn_about(axis, 0.4)));
  turns.turn(unknowns, v);
  EXPECT_EQ(v, before);
  turns.update(bar.mapped(turn_about(axis, 1.1)));
  turns.turn(unknowns, v);
  const Eigen::Matrix3d since = turn_about(axis, 0.7);
  EXPECT_LT((v.head<3>() - since * before.head<3>()).norm(), 1e-9);
  EXPECT_EQ(v.segment<2>(3), before.segment<2>(3));
  EXPECT_LT((v.tail<3>() - since * before.tail<3>()).norm(), 1e-9);
  turns.turn_back(unknowns, v);
  EXPECT_LT((v - before).norm(), 1e-9);
  turns.factored_at(bar.mapped(turn_about(axis, 1.1)));
  turns.turn(unknowns, v);
  EXPECT_LT((v - before).norm(), 1e-9);
}

/// The first correction of a step takes the ends to their places, by columns of the old matrix.
TEST(FactorTurns, EndsThatMoveByThemselvesAreFollowedWithAnOldFactor) {
  const Bar bar;
  const std::vector<int> ends = test::unknowns_where(
      bar.box.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > kBarSize.x() - 1e-9; });
  FiniteStrain form(bar.assembler, test::uniform_material(bar.box.tets.rows(), 2e4, 0.45, 0, 1000),
                    {});
  FiniteNewton newton(form, ends, {});
  const Vec3 axis(0.2, 1, 0.4);
  const auto places = [&](double angle_rad, double stretch) {
    Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
    map(0, 0) = stretch;
    const VectorXd all = bar.mapped(turn_about(axis, angle_rad) * map);
    VectorXd to(Eigen::Index(ends.size()));
    for (std::size_t k = 0; k < ends.size(); ++k) to[Eigen::Index(k)] = all[ends[k]];
    return std::pair{to, all};
  };
  const auto [turned, guess] = places(1.5, 1);
  newton.equilibrium(places(0, 1).first);
  newton.equilibrium(turned, {}, {}, &guess);
  // Now the far end is pulled along the bar as it lies.
  const FiniteStepReport pulled = newton.equilibrium(places(1.5, 1.002).first);
  EXPECT_EQ(pulled.factorisations, 0);
  EXPECT_LE(pulled.iterations, 2);
}

/// Both ends turn together, by 120 degrees in 12 steps of equilibrium: the first factor serves all.
TEST(FactorTurns, OneFactorServesABodyThatTurns) {
  const Bar bar;
  const std::vector<int> ends = test::unknowns_where(
      bar.box.nodes, [](const Vec3& p) { return p.x() < 1e-9 || p.x() > kBarSize.x() - 1e-9; });
  FiniteStrain form(bar.assembler, test::uniform_material(bar.box.tets.rows(), 2e4, 0.45, 0, 1000),
                    {});
  FiniteNewtonOptions options;
  options.tolerance = 1e-7;
  FiniteNewton newton(form, ends, options);
  int factorisations = 0, iterations = 0;
  const int steps = 12;
  Eigen::Matrix3d stretch = Eigen::Matrix3d::Identity();
  stretch(0, 0) = 1.1;
  for (int i = 0; i <= steps; ++i) {
    const VectorXd all = bar.mapped(turn_about({0.2, 1, 0.4}, i * 2.0944 / steps) * stretch);
    VectorXd to(Eigen::Index(ends.size()));
    for (std::size_t k = 0; k < ends.size(); ++k) to[Eigen::Index(k)] = all[ends[k]];
    const VectorXd guess = all;  // exact but for the contraction across
    const FiniteStepReport report = newton.equilibrium(to, {}, {}, i > 0 ? &guess : nullptr);
    if (i == 0) continue;
    factorisations += report.factorisations;
    iterations += report.iterations;
    EXPECT_EQ(report.parts, 1);
  }
  EXPECT_LE(factorisations, 1);
  EXPECT_LE(iterations, 8 * steps);
  // Turned back, it is the bar that was stretched at first.
  const Eigen::Matrix3d back = turn_about({0.2, 1, 0.4}, -2.0944);
  const VectorXd turned = newton.displacement();
  FiniteNewton still(form, ends, options);
  const VectorXd straight = bar.mapped(stretch);
  VectorXd to(Eigen::Index(ends.size()));
  for (std::size_t k = 0; k < ends.size(); ++k) to[Eigen::Index(k)] = straight[ends[k]];
  still.equilibrium(to);
  for (Eigen::Index n = 0; n < bar.box.nodes.rows(); ++n) {
    const Vec3 x = bar.box.nodes.row(n).transpose();
    EXPECT_LT(
        (back * (x + turned.segment<3>(3 * n)) - x - still.displacement().segment<3>(3 * n)).norm(),
        1e-8);
  }
}

}  // namespace
}  // namespace hyperex::fem
