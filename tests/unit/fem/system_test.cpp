// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/form/system.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/form/assembler.hpp"
#include "support/fem_support.hpp"
#include "support/refusal.hpp"

namespace hyperex::fem {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(Assemble, TheThreeMatricesShareOnePatternAndAreSymmetric) {
  const auto box = test::box_mesh({3, 2, 2}, Vec3(0.03, 0.02, 0.02), 0.1);
  const System s =
      assemble(box.nodes, box.tets, test::varied_material(box.tets.rows()), ElementKind::tet4);
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

/// The reference sums in the order of the elements, without patterns or threads.
TEST(Assemble, EqualsTheSumOfElementMatrices) {
  const auto box = test::box_mesh({3, 2, 2}, Vec3(0.03, 0.02, 0.02), 0.1);
  Material material = test::varied_material(box.tets.rows());
  for (const ViscousForm form : {ViscousForm::isotropic, ViscousForm::printed}) {
    material.viscous_form = form;
    Eigen::MatrixXd k = Eigen::MatrixXd::Zero(box.nodes.size(), box.nodes.size()), c = k, m = k;
    for (Eigen::Index t = 0; t < box.tets.rows(); ++t) {
      const Tet4 tet = make_tet4(corners_of(box.nodes, box.tets, t));
      Eigen::Matrix<double, 6, 12> b;
      std::vector<int> at;
      for (int a = 0; a < 4; ++a) {
        b.middleCols<3>(3 * a) = strain_displacement(tet.gradient.row(a));
        for (int axis = 0; axis < 3; ++axis) at.push_back(3 * box.tets(t, a) + axis);
      }
      k(at, at) += tet.volume * b.transpose() *
                   elastic_tensor(material.young_pa[t], material.poisson[t]) * b;
      c(at, at) +=
          tet.volume * b.transpose() * viscous_tensor(material.viscosity_pa_s[t], form) * b;
      for (int i = 0; i < 12; ++i)
        for (int j = i % 3; j < 12; j += 3)
          m(at[i], at[j]) += mass_entry(tet, material.density_kg_m3[t], i / 3, j / 3);
    }
    const System s = assemble(box.nodes, box.tets, material, ElementKind::tet4);
    EXPECT_LT((Eigen::MatrixXd(s.stiffness) - k).norm(), 1e-14 * k.norm());
    EXPECT_LT((Eigen::MatrixXd(s.damping) - c).norm(), 1e-14 * c.norm());
    EXPECT_LT((Eigen::MatrixXd(s.mass) - m).norm(), 1e-14 * m.norm());
  }
}

TEST(Assembler, RefillsASystemInPlaceForNewMaterials) {
  const auto box = test::box_mesh({4, 4, 3}, Vec3(0.04, 0.04, 0.03), 0.1);
  for (const ElementKind kind : kElementKinds) {
    const Assembler assembler(box.nodes, box.tets, kind);
    System kept;
    assembler.assemble(test::varied_material(box.tets.rows(), 1), kept);
    const double* const where[] = {kept.stiffness.valuePtr(), kept.damping.valuePtr(),
                                   kept.mass.valuePtr()};
    const Material other = test::varied_material(box.tets.rows(), 2);
    assembler.assemble(other, kept);
    EXPECT_EQ(kept.stiffness.valuePtr(), where[0]);
    EXPECT_EQ(kept.damping.valuePtr(), where[1]);
    EXPECT_EQ(kept.mass.valuePtr(), where[2]);
    const System fresh = assemble(box.nodes, box.tets, other, kind);
    EXPECT_TRUE((fresh.stiffness.coeffs() == kept.stiffness.coeffs()).all());
    EXPECT_TRUE((fresh.damping.coeffs() == kept.damping.coeffs()).all());
    EXPECT_TRUE((fresh.mass.coeffs() == kept.mass.coeffs()).all());
  }
}

/// The element kind changes only the resistance to changes of volume.
TEST(Assembler, KindsDifferInTheStiffnessAlone) {
  const auto box = test::box_mesh({4, 4, 3}, Vec3(0.04, 0.04, 0.03), 0.1);
  const Material material = test::varied_material(box.tets.rows());
  const System plain = assemble(box.nodes, box.tets, material, ElementKind::tet4);
  const System star = assemble(box.nodes, box.tets, material, ElementKind::tet4_star);
  EXPECT_TRUE((plain.damping.coeffs() == star.damping.coeffs()).all());
  EXPECT_TRUE((plain.mass.coeffs() == star.mass.coeffs()).all());
  EXPECT_GT((plain.stiffness - star.stiffness).norm(), 0.01 * plain.stiffness.norm());
  const Eigen::VectorXd d = test::random_vector(box.nodes.size(), 5);
  EXPECT_LT(d.dot(star.stiffness * d), d.dot(plain.stiffness * d)) << "averages resist less";
  const Points field = test::unflat(d);
  const Assembler of_star(box.nodes, box.tets, ElementKind::tet4_star);
  EXPECT_EQ(of_star.von_mises_pa(material, field),
            von_mises_pa(ElementStrain(box.nodes, box.tets).at(field), material));
}

TEST(Assemble, GivesTheSameNumbersOnEachRunAndOnAnyNumberOfThreads) {
  const auto box = test::box_mesh({8, 8, 3}, Vec3(0.08, 0.08, 0.03), 0.1);
  const Material material = test::varied_material(box.tets.rows());
  const auto star = ElementKind::tet4_star;
  const System first = assemble(box.nodes, box.tets, material, star);
  for (std::size_t run = 1; run <= 5; ++run) {
    const tbb::global_control threads(tbb::global_control::max_allowed_parallelism, run);
    const System again = assemble(box.nodes, box.tets, material, star);
    EXPECT_TRUE((first.stiffness.coeffs() == again.stiffness.coeffs()).all());
    EXPECT_TRUE((first.damping.coeffs() == again.damping.coeffs()).all());
    EXPECT_TRUE((first.mass.coeffs() == again.mass.coeffs()).all());
  }
}

TEST(Assemble, NamesTheFirstElementWithoutPositiveVolume) {
  auto box = test::box_mesh({2, 1, 1}, Vec3(0.02, 0.01, 0.01));
  const Material material = test::uniform_material(box.tets.rows(), 1e5, 0.4, 0, 1000);
  std::swap(box.tets(7, 0), box.tets(7, 1));
  EXPECT_THAT(test::refusal<NumericalError>(
                  [&] { assemble(box.nodes, box.tets, material, ElementKind::tet4); }),
              AllOf(HasSubstr("tetrahedron 7 "), HasSubstr("positive")));
  box.tets(7, 0) = box.tets(7, 1);
  EXPECT_THROW(assemble(box.nodes, box.tets, material, ElementKind::tet4), NumericalError);
}

TEST(VonMises, IsTheStressOfUniaxialTensionAndRootThreeTimesShear) {
  const auto box = test::box_mesh({2, 2, 2}, Vec3(0.02, 0.02, 0.02), 0.1);
  const double young = 192.4e3, nu = 0.45;
  const Material material = test::uniform_material(box.tets.rows(), young, nu, 0, 1000);
  const ElementStrain strain(box.nodes, box.tets);
  const Points tension = 1e-3 * box.nodes * Vec3(1, -nu, -nu).asDiagonal();
  EXPECT_LT((von_mises_pa(strain.at(tension), material).array() - 1e-3 * young).abs().maxCoeff(),
            1e-8);
  for (int axis = 0; axis < 3; ++axis) {
    Points shear = Points::Zero(box.nodes.rows(), 3);
    shear.col(axis) = 1e-3 * box.nodes.col((axis + 1) % 3);
    const double tau = 1e-3 * young / (2 * (1 + nu));
    EXPECT_LT(
        (von_mises_pa(strain.at(shear), material).array() - std::sqrt(3.0) * tau).abs().maxCoeff(),
        1e-8);
  }
}

}  // namespace
}  // namespace hyperex::fem
