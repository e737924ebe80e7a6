// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/core/error.hpp"
#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Assemble, TheThreeMatricesShareOnePatternAndAreSymmetric) {
  const auto box = test::box_mesh({3, 2, 2}, Vec3(0.03, 0.02, 0.02), 0.1);
  const System s = assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()));
  const auto count = s.stiffness.nonZeros();
  for (const SparseMatrix* m : {&s.stiffness, &s.damping, &s.mass}) {
    ASSERT_EQ(m->nonZeros(), count);
    EXPECT_TRUE(
        std::equal(m->innerIndexPtr(), m->innerIndexPtr() + count, s.stiffness.innerIndexPtr()));
    const Eigen::MatrixXd dense(*m);
    EXPECT_GT(dense.norm(), 0);
    EXPECT_LT((dense - dense.transpose()).norm(), 1e-14 * dense.norm());
  }
}

TEST(Assemble, GivesTheSameNumbersOnEachRun) {
  const auto box = test::box_mesh({8, 8, 3}, Vec3(0.08, 0.08, 0.03), 0.1);
  const Material material = test::varied_material(box.tets.rows());
  const System first = assemble(box.nodes, box.tets, material);
  for (int run = 0; run < 5; ++run) {
    const System again = assemble(box.nodes, box.tets, material);
    EXPECT_TRUE((first.stiffness.coeffs() == again.stiffness.coeffs()).all());
    EXPECT_TRUE((first.damping.coeffs() == again.damping.coeffs()).all());
    EXPECT_TRUE((first.mass.coeffs() == again.mass.coeffs()).all());
  }
}

TEST(Assemble, NamesTheFirstElementWithoutPositiveVolume) {
  auto box = test::box_mesh({2, 1, 1}, Vec3(0.02, 0.01, 0.01));
  const Material material = test::uniform_material(box.tets.rows(), 1e5, 0.4, 0, 1000);
  std::swap(box.tets(7, 0), box.tets(7, 1));
  try {
    assemble(box.nodes, box.tets, material);
    FAIL() << "an inverted element was taken";
  } catch (const NumericalError& e) {
    EXPECT_THAT(e.what(), AllOf(HasSubstr("tetrahedron 7 "), HasSubstr("positive")));
  }
  box.tets(7, 0) = box.tets(7, 1);
  EXPECT_THROW(assemble(box.nodes, box.tets, material), NumericalError);
}

TEST(VonMises, IsTheStressOfUniaxialTensionAndRootThreeTimesShear) {
  const auto box = test::box_mesh({2, 2, 2}, Vec3(0.02, 0.02, 0.02), 0.1);
  const double young = 192.4e3, nu = 0.45;
  const Material material = test::uniform_material(box.tets.rows(), young, nu, 0, 1000);
  const Points tension = 1e-3 * box.nodes * Vec3(1, -nu, -nu).asDiagonal();
  EXPECT_LT((von_mises_pa(box.nodes, box.tets, material, tension).array() - 1e-3 * young)
                .abs()
                .maxCoeff(),
            1e-8);
  for (int axis = 0; axis < 3; ++axis) {
    Points shear = Points::Zero(box.nodes.rows(), 3);
    shear.col(axis) = 1e-3 * box.nodes.col((axis + 1) % 3);
    const double tau = 1e-3 * young / (2 * (1 + nu));
    EXPECT_LT((von_mises_pa(box.nodes, box.tets, material, shear).array() - std::sqrt(3.0) * tau)
                  .abs()
                  .maxCoeff(),
              1e-8);
  }
}

}  // namespace
}  // namespace hyperex::fem
