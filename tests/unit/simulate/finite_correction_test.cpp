// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/finite_correction.hpp"

#include <gtest/gtest.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/static_solve.hpp"
#include "support/fem_support.hpp"

namespace hyperex::simulate {
namespace {

/// A block on a held base.
class CorrectedBlock : public testing::Test {
 protected:
  FiniteCorrection correction(fem::SparseMatrix springs = {}) const {
    fem::FiniteNewtonOptions how;
    how.tolerance = 1e-9;
    how.least_motion_m = 1e-9;
    return {assembler_, material_, {}, std::move(springs), held_, how, nullptr};
  }
  /// A push on the top, along x and down.
  Eigen::VectorXd push(double newton) const {
    Eigen::VectorXd force = Eigen::VectorXd::Zero(3 * box_.nodes.rows());
    for (Eigen::Index n = 0; n < box_.nodes.rows(); ++n)
      if (box_.nodes(n, 2) > 0.0199) force.segment<3>(3 * n) = newton * Vec3(1, 0.3, -0.5);
    return force;
  }
  /// The block leaned by some millimetres, its base moved a little: a moment of a motion.
  Eigen::VectorXd leaned() const {
    Eigen::VectorXd d = Eigen::VectorXd::Zero(3 * box_.nodes.rows());
    for (Eigen::Index n = 0; n < box_.nodes.rows(); ++n) {
      const double z = box_.nodes(n, 2) / 0.02;
      d.segment<3>(3 * n) = z * z * Vec3(0.003, 0.001, -0.0005) + Vec3(4e-4, 0, 2e-4);
    }
    return d;
  }

  const hyperex::test::BoxMesh box_ =
      hyperex::test::box_mesh({3, 3, 3}, Vec3(0.02, 0.02, 0.02), 0.1);
  const fem::Material material_ = hyperex::test::varied_material(box_.tets.rows());
  const fem::Assembler assembler_{box_.nodes, box_.tets, fem::ElementKind::tet4_star};
  const std::vector<int> held_ =
      hyperex::test::unknowns_where(box_.nodes, [](const Vec3& p) { return p.z() < 1e-9; });
};

TEST_F(CorrectedBlock, AtRestASmallForceGivesTheLinearAnswer) {
  fem::System system;
  assembler_.assemble(material_, system);
  const Eigen::VectorXd force = push(1e-6);
  const Eigen::VectorXd linear =
      fem::StaticSolver(system.stiffness, held_).solve(Eigen::VectorXd::Zero(held_.size()), force);
  FiniteCorrection tissue = correction();
  tissue.begin(Eigen::VectorXd::Zero(force.size()));
  EXPECT_LT((tissue.under(force) - linear).norm(), 1e-3 * linear.norm());
}

TEST_F(CorrectedBlock, TheForcesOfTheMomentStayAndTheFurtherOnesAreMet) {
  FiniteCorrection tissue = correction();
  const Eigen::VectorXd d0 = leaned(), more = push(0.02);
  tissue.begin(d0);
  EXPECT_LT((tissue.under(0 * more) - d0).cwiseAbs().maxCoeff(), 1e-9) << "none: nothing moves";
  const Eigen::VectorXd d = tissue.under(more);
  EXPECT_GT((d - d0).cwiseAbs().maxCoeff(), 1e-4);
  fem::FiniteStrain form(assembler_, material_, {});
  Eigen::VectorXd before(d.size()), after(d.size());
  form.rest_at(d0);
  form.energy_and_gradient(d0, before);
  form.energy_and_gradient(d, after);
  Eigen::VectorXd left = after - before - more;
  for (const int u : held_) left[u] = 0;
  EXPECT_LT(left.norm(), 1e-6 * more.norm());
  for (const int u : held_) EXPECT_EQ(d[u], d0[u]);
  EXPECT_LT((tissue.under(0 * more) - d0).cwiseAbs().maxCoeff(), 1e-8) << "and taken away again";
}

TEST_F(CorrectedBlock, SpringsPullInTheMomentAsTheyDid) {
  fem::SparseMatrix springs = assembler_.stiffness_pattern();
  for (Eigen::Index u = 0; u < springs.cols(); ++u) springs.coeffRef(u, u) = 50;
  springs.prune(0.0);
  const Eigen::VectorXd d0 = leaned(), more = push(0.02);
  FiniteCorrection held = correction(springs), free = correction();
  held.begin(d0);
  EXPECT_LT((held.under(0 * more) - d0).cwiseAbs().maxCoeff(), 1e-8) << "none: nothing moves";
  const double by = (held.under(more) - d0).norm();
  free.begin(d0);
  EXPECT_LT(by, 0.9 * (free.under(more) - d0).norm());
}

TEST_F(CorrectedBlock, AForceThatNothingCanMeetLeavesItUsable) {
  FiniteCorrection tissue = correction();
  tissue.begin(Eigen::VectorXd::Zero(3 * box_.nodes.rows()));
  EXPECT_THROW(tissue.under(push(1e9)), NumericalError);
  const Eigen::VectorXd small = push(1e-3);
  EXPECT_GT(tissue.under(small).norm(), 0);
}

}  // namespace
}  // namespace hyperex::simulate
