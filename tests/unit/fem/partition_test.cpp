// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/partition.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "support/fem_support.hpp"

namespace hyperex::fem {
namespace {

class PartitionOf : public testing::TestWithParam<ElementKind> {
 protected:
  const test::BoxMesh box_ = test::box_mesh({4, 3, 2}, Vec3(0.04, 0.03, 0.02), 0.1);
  const System system_ =
      assemble(box_.nodes, box_.tets, test::varied_material(box_.tets.rows()), GetParam());
  int unknowns() const { return static_cast<int>(system_.mass.cols()); }
  /// None, whole nodes, single axes, all but one, all.
  std::vector<std::vector<int>> choices() const {
    const auto all = test::complement(unknowns(), {});
    return {{},
            test::unknowns_where(box_.nodes, [](const Vec3& p) { return p.x() < 1e-9; }),
            test::unknowns_where(box_.nodes, [](const Vec3& p) { return p.z() > 0.01; }, {0, 2}),
            {0, unknowns() - 1},
            test::complement(unknowns(), {7}),
            all};
  }
};

void expect_sorted_and_compressed(const SparseMatrix& m) {
  EXPECT_TRUE(m.isCompressed());
  for (Eigen::Index c = 0; c < m.cols(); ++c)
    EXPECT_TRUE(std::is_sorted(m.innerIndexPtr() + m.outerIndexPtr()[c],
                               m.innerIndexPtr() + m.outerIndexPtr()[c + 1]));
}

TEST_P(PartitionOf, SplitsTheUnknowns) {
  for (const std::vector<int>& prescribed : choices()) {
    const Partition p(unknowns(), prescribed);
    EXPECT_EQ(p.unknowns(), unknowns());
    EXPECT_EQ(p.prescribed, prescribed);
    EXPECT_EQ(p.free, test::complement(unknowns(), prescribed));
    for (const int c : prescribed) EXPECT_EQ(p.free_index[c], -1);
    for (std::size_t i = 0; i < p.free.size(); ++i)
      EXPECT_EQ(p.free_index[p.free[i]], static_cast<int>(i));
  }
}

TEST_P(PartitionOf, TakesTheBlocksOfADenseMatrix) {
  const Eigen::MatrixXd k(system_.stiffness);
  for (const std::vector<int>& prescribed : choices()) {
    const Partition p(unknowns(), prescribed);
    const SparseMatrix lower = free_lower(system_.stiffness, p);
    const SparseMatrix oc = coupling(system_.stiffness, p);
    expect_sorted_and_compressed(lower);
    expect_sorted_and_compressed(oc);
    const Eigen::MatrixXd oo = k(p.free, p.free);
    EXPECT_EQ(Eigen::MatrixXd(lower), Eigen::MatrixXd(oo.triangularView<Eigen::Lower>()));
    EXPECT_EQ(Eigen::MatrixXd(oc), Eigen::MatrixXd(k(p.free, p.prescribed)));
    for (Eigen::Index c = 0; c < lower.cols(); ++c)
      EXPECT_EQ(lower.innerIndexPtr()[lower.outerIndexPtr()[c]], c) << "the diagonal comes first";
  }
}

TEST_P(PartitionOf, CombinesMatricesOfDifferentPatterns) {
  if (GetParam() == ElementKind::tet4_star) {
    ASSERT_GT(system_.stiffness.nonZeros(), 1.2 * double(system_.damping.nonZeros()));
  }
  const Eigen::MatrixXd k(system_.stiffness), c(system_.damping), m(system_.mass);
  for (const auto& [of_c, of_m] : {std::pair{0.0, 0.0}, {1000.0, 1e6}, {-3.0, 0.5}}) {
    const SparseMatrix a = combined(system_, of_c, of_m);
    ASSERT_EQ(a.nonZeros(), system_.stiffness.nonZeros());
    EXPECT_TRUE(std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(),
                           system_.stiffness.innerIndexPtr()));
    const Eigen::MatrixXd expected = k + of_c * c + of_m * m;
    EXPECT_LT((Eigen::MatrixXd(a) - expected).cwiseAbs().maxCoeff(),
              1e-15 * expected.cwiseAbs().maxCoeff());
  }
}

INSTANTIATE_TEST_SUITE_P(Kinds, PartitionOf, testing::ValuesIn(kElementKinds),
                         [](const auto& kind) {
                           return kind.param == ElementKind::tet4 ? "tet4" : "tet4_star";
                         });

}  // namespace
}  // namespace hyperex::fem
