// SPDX-License-Identifier: GPL-3.0-or-later
// Patch test, rigid motions, null spaces, sums, and derivatives of the energies by finite
// differences: on distorted meshes, with a different material in every element where it may be.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "hyperex/fem/solve/static_solve.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

const Vec3 kSize(0.04, 0.03, 0.02);

test::BoxMesh distorted_box() {
  return test::box_mesh({4, 3, 3}, kSize, 0.15);
}

bool on_boundary(const Vec3& p) {
  return (p.array() < 1e-12).any() || (p.array() > kSize.array() - 1e-12).any();
}

Points linear_field(const Points& nodes, const Eigen::Matrix3d& gradient) {
  return (nodes * gradient.transpose()).rowwise() + Eigen::RowVector3d(1e-3, -2e-3, 5e-4);
}

TEST(PatchTest, LinearBoundaryDisplacementGivesTheLinearFieldInside) {
  const auto box = distorted_box();
  const auto boundary = test::unknowns_where(box.nodes, on_boundary);
  ASSERT_GT(box.nodes.size() - static_cast<Eigen::Index>(boundary.size()), 30);
  for (const double nu : {0.0, 0.3, 0.495}) {
    const Material m = test::uniform_material(box.tets.rows(), 192.4e3, nu, 0, 1100);
    const StaticSolver solver(assemble(box.nodes, box.tets, m).stiffness, boundary);
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const Eigen::Matrix3d g = 0.01 * test::random_vector(9, seed).reshaped(3, 3);
      const Eigen::VectorXd exact = test::flat(linear_field(box.nodes, g));
      const Eigen::VectorXd d = solver.solve(exact(boundary));
      EXPECT_LT((d - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
      const auto strain = element_strain(box.nodes, box.tets, test::unflat(d));
      Eigen::Matrix<double, 1, 6> expected;
      expected << g(0, 0), g(1, 1), g(2, 2), g(0, 1) + g(1, 0), g(1, 2) + g(2, 1),
          g(2, 0) + g(0, 2);
      EXPECT_LT((strain.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.norm());
    }
  }
}

TEST(PatchTest, BoundaryForcesCarryTheStressAndInnerOnesVanish) {
  const auto box = distorted_box();
  const double young = 192.4e3, nu = 0.4;
  const double lambda = young * nu / (1 + nu) / (1 - 2 * nu), mu = young / 2 / (1 + nu);
  const Material m = test::uniform_material(box.tets.rows(), young, nu, 0, 1100);
  const System s = assemble(box.nodes, box.tets, m);
  const Eigen::Matrix3d g = 0.01 * test::random_vector(9, 5).reshaped(3, 3);
  const Eigen::Matrix3d stress =
      lambda * g.trace() * Eigen::Matrix3d::Identity() + mu * (g + g.transpose());
  const Points force = test::unflat(s.stiffness * test::flat(linear_field(box.nodes, g)));
  const double unit = stress.norm() * kSize.prod() / kSize.norm();

  for (int axis = 0; axis < 3; ++axis) {
    // By equilibrium the sum of f_i x_j over all nodes is stress_ij times the volume.
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    for (Eigen::Index n = 0; n < box.nodes.rows(); ++n) {
      const Vec3 p = box.nodes.row(n).transpose();
      sum += force.row(n) * p[axis];
      if (!on_boundary(p)) {
        EXPECT_LT(force.row(n).norm(), 1e-12 * unit);
      }
    }
    EXPECT_LT((sum.transpose() / kSize.prod() - stress.col(axis)).norm(), 1e-11 * stress.norm());
  }
}

TEST(RigidMotion, GivesNoStressAndNoForce) {
  const auto box = distorted_box();
  const Material m = test::varied_material(box.tets.rows());
  const System s = assemble(box.nodes, box.tets, m);
  for (int motion = 0; motion < 6; ++motion) {
    Points d = Points::Zero(box.nodes.rows(), 3);
    if (motion < 3)
      d.col(motion).setConstant(0.01);
    else
      for (Eigen::Index n = 0; n < d.rows(); ++n)
        d.row(n) = Vec3::Unit(motion - 3).cross(Vec3(box.nodes.row(n).transpose())).transpose();
    const double stiff = 2e5 * d.norm();
    EXPECT_LT(von_mises_pa(box.nodes, box.tets, m, d).maxCoeff(), 1e-10 * stiff) << motion;
    EXPECT_LT(element_strain(box.nodes, box.tets, d).cwiseAbs().maxCoeff(), 1e-13) << motion;
    EXPECT_LT((s.stiffness * test::flat(d)).norm(), 1e-14 * s.stiffness.norm()) << motion;
    EXPECT_LT((s.damping * test::flat(d)).norm(), 1e-14 * s.damping.norm()) << motion;
  }
}

/// Eigenvalues relative to the largest, rising.
Eigen::VectorXd spectrum(const SparseMatrix& m) {
  const Eigen::MatrixXd dense(m);
  const Eigen::VectorXd values =
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues();
  return values / values.tail<1>()[0];
}

TEST(Spectrum, StiffnessIsSemidefiniteWithSixZeroModes) {
  const auto box = test::box_mesh({3, 2, 2}, kSize, 0.15);
  const Eigen::VectorXd k =
      spectrum(assemble(box.nodes, box.tets, test::varied_material(box.tets.rows())).stiffness);
  EXPECT_LT(k.head<6>().cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT(k[6], 1e-6);
}

TEST(Spectrum, DampingDissipatesAllButRigidMotionAndSwelling) {
  const auto box = test::box_mesh({3, 2, 2}, kSize, 0.15);
  Material m = test::varied_material(box.tets.rows());
  for (const ViscousForm form : {ViscousForm::isotropic, ViscousForm::printed}) {
    m.viscous_form = form;
    const System s = assemble(box.nodes, box.tets, m);
    const Eigen::VectorXd c = spectrum(s.damping);
    EXPECT_LT(c.head<7>().cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_GT(c[7], 1e-6);
    EXPECT_LT((s.damping * test::flat(box.nodes)).norm(),
              1e-14 * s.damping.norm() * box.nodes.norm());
  }
}

TEST(Mass, IsPositiveAndSumsToDensityTimesVolumeOnEachAxis) {
  const auto box = distorted_box();
  const double expected = 1100 * kSize.prod();
  const SparseMatrix mass =
      assemble(box.nodes, box.tets, test::uniform_material(box.tets.rows(), 1e5, 0.4, 0, 1100))
          .mass;
  EXPECT_GT(spectrum(mass)[0], 1e-3);
  for (int axis = 0; axis < 3; ++axis)
    for (int other = 0; other < 3; ++other) {
      Points along = Points::Zero(box.nodes.rows(), 3), across = along;
      along.col(axis).setOnes();
      across.col(other).setOnes();
      EXPECT_NEAR(test::flat(across).dot(mass * test::flat(along)), axis == other ? expected : 0,
                  1e-12 * expected);
    }
}

/// The potential's gradient by central differences (exact for quadratics, to rounding) in every
/// unknown, against matrix * x; entries scaled by the largest.
double gradient_error(const std::function<double(const Points&)>& potential,
                      const SparseMatrix& matrix, const Eigen::VectorXd& x, double step) {
  const Eigen::VectorXd product = matrix * x;
  double worst = 0;
  Eigen::VectorXd moved = x;
  for (Eigen::Index i = 0; i < x.size(); ++i) {
    moved[i] = x[i] + step;
    const double up = potential(test::unflat(moved));
    moved[i] = x[i] - step;
    const double down = potential(test::unflat(moved));
    moved[i] = x[i];
    worst = std::max(worst, std::abs((up - down) / (2 * step) - product[i]));
  }
  return worst / product.cwiseAbs().maxCoeff();
}

TEST(Derivatives, OfTheEnergiesByFiniteDifferencesAreTheMatrices) {
  const auto box = test::box_mesh({2, 2, 2}, kSize, 0.15);
  const Material m = test::varied_material(box.tets.rows());
  const System s = assemble(box.nodes, box.tets, m);
  const Eigen::VectorXd x = 1e-3 * test::random_vector(box.nodes.size(), 9);
  EXPECT_LT(gradient_error([&](const Points& d) { return test::strain_energy(box, m, d); },
                           s.stiffness, x, 1e-3),
            1e-11);
  EXPECT_LT(gradient_error([&](const Points& v) { return test::dissipation_potential(box, m, v); },
                           s.damping, x, 1e-3),
            1e-11);
  EXPECT_LT(gradient_error([&](const Points& v) { return test::kinetic_energy(box, m, v); }, s.mass,
                           x, 1e-3),
            1e-11);
}

}  // namespace
}  // namespace hyperex::fem
