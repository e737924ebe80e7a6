// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/factor_memory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/core/error.hpp"
#include "hyperex/fem/solve/partitioned_factor.hpp"
#include "support/fem_support.hpp"
#include "support/refusal.hpp"

namespace hyperex::fem {
namespace {

constexpr double kGib = 1ULL << 30U;

std::string refusal(const FactorForecast& forecast, double available_bytes) {
  return test::refusal<NumericalError>(
      [&] { check_factor_fits(forecast, available_bytes, "test"); });
}

TEST(FactorMemory, CountsTheFactorItsStackAndItsWorkspace) {
  EXPECT_DOUBLE_EQ(factor_bytes({4e6, 1e9, 1e5}), 1.2 * 4e6 * 8 * 1.5 + 8 * 1e5);
}

TEST(FactorMemory, RefusesAFactorThatDoesNotFitWithTheFigures) {
  const FactorForecast small{4e6, 1e9, 1e5}, large{1e9, 5e12, 1e7};
  EXPECT_EQ(refusal(small, kGib), "");
  EXPECT_EQ(refusal(large, 64 * kGib), "");
  EXPECT_EQ(refusal(large, 9 * kGib),
            "test: the factor of the matrix takes 14 GB of memory and 9.66 GB are available; a "
            "coarser mesh takes less");
  // Less than 1 MB is stated in words; rounded, it would read "0 MB".
  EXPECT_THAT(refusal(large, 4e7), testing::HasSubstr(" and 40 MB are available"));
  // The limit itself.
  const double needed = factor_bytes(small) / kFactorShare;
  EXPECT_EQ(refusal(small, 1.001 * needed), "");
  EXPECT_NE(refusal(small, 0.999 * needed), "");
}

TEST(FactorMemory, RefusesMoreEntriesThanCanBeCountedHoweverMuchMemoryThereIs) {
  EXPECT_EQ(refusal({2e9, 1e13, 1e8}, 1000 * kGib),
            "test: the factor of the matrix would have 2.4e+09 entries, and at most 2.15e+09 are "
            "possible; a coarser mesh has fewer");
}

TEST(FactorMemory, IsCheckedBeforeAFactorIsMade) {
  const test::BoxMesh box = test::box_mesh({2, 2, 2}, Vec3(0.02, 0.02, 0.02), 0);
  const System system = assemble(
      box.nodes, box.tets, test::uniform_material(box.tets.rows(), 192.4e3, 0.495, 476.8, 1100),
      ElementKind::tet4);
  const std::vector<int> held =
      test::unknowns_where(box.nodes, [](const Vec3& p) { return p.z() < 1e-9; });
  const PartitionedFactor factor(system.stiffness, held, "test");
  EXPECT_GE(factor.forecast().entries, factor.forecast().matrix_entries);
  // The same order with the forecast of a mesh of millions of nodes: nothing of it is allocated.
  auto order = std::make_shared<NodeOrder>(*factor.order());
  order->entries = 1e12;
  EXPECT_THAT(test::refusal<NumericalError>(
                  [&] { PartitionedFactor(system.stiffness, held, "static solution", order); }),
              testing::StartsWith("static solution: the factor of the matrix would"));
}

TEST(FactorMemory, FindsTheMemoryOfThisMachine) {
  EXPECT_GT(available_memory_bytes(), 1e6);
  EXPECT_LT(available_memory_bytes(), 1e14);
}

}  // namespace
}  // namespace hyperex::fem
