// SPDX-License-Identifier: GPL-3.0-or-later
// Conditions for every element kind and material: patch test, rigid motions, null spaces, sums, and
// derivatives of the energies by finite differences. The meshes are distorted, with a different
// material in every element where possible.
#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include "hyperex/fem/solve/static_solve.hpp"
#include "support/conformance.hpp"

namespace hyperex::fem {
namespace {

using test::Conformance;

INSTANTIATE_TEST_SUITE_P(AllKinds, Conformance, testing::ValuesIn(test::all_cases()),
                         [](const auto& tested) { return test::Case::name(tested.param); });

TEST_P(Conformance, PatchTestLinearBoundaryDisplacementGivesTheLinearFieldInside) {
  const auto box = fine();
  const auto boundary = test::unknowns_where(box.nodes, on_boundary);
  ASSERT_GT(box.nodes.size() - static_cast<Eigen::Index>(boundary.size()), 30);
  for (const double nu : {0.0, 0.3, 0.495, 0.4999}) {
    const Material m = test::uniform_material(box.tets.rows(), 192.4e3, nu, 0, 1100);
    const StaticSolver solver(assembled(box, m).stiffness, boundary);
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const Eigen::Matrix3d g = 0.01 * test::random_vector(9, seed).reshaped(3, 3);
      const Eigen::VectorXd exact = test::flat(linear_field(box.nodes, g));
      const Eigen::VectorXd d = solver.solve(exact(boundary));
      EXPECT_LT((d - exact).cwiseAbs().maxCoeff(), 1e-10 * exact.cwiseAbs().maxCoeff());
      const auto strain = assembler(box).strain(test::unflat(d));
      Eigen::Matrix<double, 1, 6> expected;
      expected << g(0, 0), g(1, 1), g(2, 2), g(0, 1) + g(1, 0), g(1, 2) + g(2, 1),
          g(2, 0) + g(0, 2);
      EXPECT_LT((strain.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-10 * expected.norm());
      const auto stress = assembler(box).stress_pa(m, test::unflat(d));
      expected = expected * elastic_tensor(192.4e3, nu);
      // The bulk modulus amplifies the rounding error of the dilatation.
      EXPECT_LT((stress.rowwise() - expected).cwiseAbs().maxCoeff(), 1e-8 * expected.norm());
    }
  }
}

TEST_P(Conformance, PatchTestBoundaryForcesCarryTheStressAndInnerOnesVanish) {
  const auto box = fine();
  const double young = 192.4e3, nu = 0.4;
  const double lambda = young * nu / (1 + nu) / (1 - 2 * nu), mu = young / 2 / (1 + nu);
  const Material m = test::uniform_material(box.tets.rows(), young, nu, 0, 1100);
  const System s = assembled(box, m);
  const Eigen::Matrix3d g = 0.01 * test::random_vector(9, 5).reshaped(3, 3);
  const Eigen::Matrix3d stress =
      lambda * g.trace() * Eigen::Matrix3d::Identity() + mu * (g + g.transpose());
  const Points force = test::unflat(s.stiffness * test::flat(linear_field(box.nodes, g)));
  const double unit = stress.norm() * kSize.prod() / kSize.norm();

  for (int axis = 0; axis < 3; ++axis) {
    // In equilibrium, the sum of f_i x_j over all nodes is stress_ij times the volume.
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

TEST_P(Conformance, RigidMotionGivesNoStressAndNoForce) {
  const auto box = fine();
  const Material m = varied(box);
  const System s = assembled(box, m);
  for (int motion = 0; motion < 6; ++motion) {
    Points d = Points::Zero(box.nodes.rows(), 3);
    if (motion < 3)
      d.col(motion).setConstant(0.01);
    else
      for (Eigen::Index n = 0; n < d.rows(); ++n)
        d.row(n) = Vec3::Unit(motion - 3).cross(Vec3(box.nodes.row(n).transpose())).transpose();
    const double stiff = 2e5 * d.norm();
    EXPECT_LT(assembler(box).von_mises_pa(m, d).maxCoeff(), 1e-10 * stiff) << motion;
    EXPECT_LT(assembler(box).stress_pa(m, d).cwiseAbs().maxCoeff(), 1e-9 * stiff) << motion;
    EXPECT_LT(ElementStrain(box.nodes, box.tets).at(d).cwiseAbs().maxCoeff(), 1e-13) << motion;
    EXPECT_LT((s.stiffness * test::flat(d)).norm(), 1e-14 * s.stiffness.norm()) << motion;
    EXPECT_LT((s.damping * test::flat(d)).norm(), 1e-14 * s.damping.norm()) << motion;
  }
}

TEST_P(Conformance, MatricesAreSymmetricOnPatternsThatHoldWholeBlocks) {
  const auto box = fine();
  const System s = assembled(box, varied(box));
  const auto count = s.mass.nonZeros();
  ASSERT_EQ(s.damping.nonZeros(), count);
  EXPECT_TRUE(std::equal(s.mass.innerIndexPtr(), s.mass.innerIndexPtr() + count,
                         s.damping.innerIndexPtr()));
  for (const SparseMatrix* m : {&s.stiffness, &s.damping, &s.mass}) {
    const SparseMatrix difference = *m - SparseMatrix(m->transpose());
    EXPECT_LT(difference.norm(), 1e-14 * m->norm());
    EXPECT_EQ(difference.nonZeros(), m->nonZeros()) << "the pattern is not symmetric";
    ASSERT_TRUE(m->isCompressed());
    for (int column = 0; column < m->cols(); ++column)
      for (int k = m->outerIndexPtr()[column]; k < m->outerIndexPtr()[column + 1]; k += 3) {
        const int row = m->innerIndexPtr()[k];
        ASSERT_EQ(row % 3, 0);
        ASSERT_EQ(m->innerIndexPtr()[k + 1], row + 1);
        ASSERT_EQ(m->innerIndexPtr()[k + 2], row + 2);
        ASSERT_TRUE(k == m->outerIndexPtr()[column] || m->innerIndexPtr()[k - 1] < row);
        ASSERT_EQ(row, m->innerIndexPtr()[m->outerIndexPtr()[column / 3 * 3] + k -
                                          m->outerIndexPtr()[column]]);
      }
  }
  // Every node pair of the damping's pattern is in the stiffness's.
  for (int column = 0; column < s.mass.cols(); ++column) {
    const auto* from = s.stiffness.innerIndexPtr();
    EXPECT_TRUE(std::includes(from + s.stiffness.outerIndexPtr()[column],
                              from + s.stiffness.outerIndexPtr()[column + 1],
                              s.mass.innerIndexPtr() + s.mass.outerIndexPtr()[column],
                              s.mass.innerIndexPtr() + s.mass.outerIndexPtr()[column + 1]));
  }
}

TEST_P(Conformance, StiffnessIsSemidefiniteWithSixZeroModes) {
  const auto box = test::box_mesh({3, 2, 2}, kSize, 0.15);
  for (const double nu : {0.3, 0.495}) {
    Material m = varied(box);
    m.poisson.assign(m.poisson.size(), nu);
    const Eigen::VectorXd k = test::spectrum(assembled(box, m).stiffness);
    EXPECT_LT(k.head<6>().cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_GT(k[6], 1e-5 * (1 - 2 * nu));
  }
}

TEST_P(Conformance, DampingDissipatesAllButRigidMotionAndSwelling) {
  const auto box = test::box_mesh({3, 2, 2}, kSize, 0.15);
  const System s = assembled(box, varied(box));
  const Eigen::VectorXd c = test::spectrum(s.damping);
  EXPECT_LT(c.head<7>().cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_GT(c[7], 1e-6);
  EXPECT_LT((s.damping * test::flat(box.nodes)).norm(),
            1e-14 * s.damping.norm() * box.nodes.norm());
}

TEST_P(Conformance, MassIsPositiveAndSumsToDensityTimesVolumeOnEachAxis) {
  const auto box = test::box_mesh({4, 3, 3}, kSize, 0.15);
  const double expected = 1100 * kSize.prod();
  const SparseMatrix mass =
      assembled(box, test::uniform_material(box.tets.rows(), 1e5, 0.4, 0, 1100)).mass;
  EXPECT_GT(test::spectrum(mass)[0], 1e-3);
  for (int axis = 0; axis < 3; ++axis)
    for (int other = 0; other < 3; ++other) {
      Points along = Points::Zero(box.nodes.rows(), 3), across = along;
      along.col(axis).setOnes();
      across.col(other).setOnes();
      EXPECT_NEAR(test::flat(across).dot(mass * test::flat(along)), axis == other ? expected : 0,
                  1e-12 * expected);
    }
}

TEST_P(Conformance, DerivativesOfTheEnergiesByFiniteDifferencesAreTheMatrices) {
  const auto box = coarse();
  const Material m = varied(box);
  const System s = assembled(box, m);
  const Eigen::VectorXd x = 1e-3 * test::random_vector(box.nodes.size(), 9);
  const auto of = [&](auto energy, const SparseMatrix& matrix) {
    return test::gradient_error(energy, matrix, x, 1e-3);
  };
  EXPECT_LT(of([&](const Points& d) { return strain_energy(box, m, d); }, s.stiffness), 1e-11);
  EXPECT_LT(of([&](const Points& v) { return dissipation(box, m, v); }, s.damping), 1e-11);
  EXPECT_LT(of([&](const Points& v) { return test::kinetic_energy(box, m, v); }, s.mass), 1e-11);
}

TEST_P(Conformance, TheRecoveredStressDoesTheWork) {
  const auto box = fine();
  const Material m = varied(box);
  const auto d = test::unflat(test::random_vector(box.nodes.size(), 3));
  const auto v = test::unflat(test::random_vector(box.nodes.size(), 4));
  const VoigtRows stress = assembler(box).stress_pa(m, d), rate = assembler(box).strain(v);
  double work = 0, size = 0;
  for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
    const double of_element =
        test::volume_of(box.nodes, box.tets, t) * stress.row(t).dot(rate.row(t));
    work += of_element;
    size += std::abs(of_element);
  }
  EXPECT_NEAR(work, test::flat(v).dot(assembled(box, m).stiffness * test::flat(d)), 1e-12 * size);
  EXPECT_LT((stress.leftCols<3>().rowwise().mean() + assembler(box).pressure_pa(m, d))
                .cwiseAbs()
                .maxCoeff(),
            1e-12 * stress.norm());
}

}  // namespace
}  // namespace hyperex::fem
