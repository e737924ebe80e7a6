// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/error_budget.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "hyperex/metrics/excursion_budget.hpp"
#include "hyperex/metrics/repetition_floor.hpp"

namespace hyperex::metrics {
namespace {

TEST(ErrorBudget, OfStatedErrorsIsTheRootOfTheSumOfSquares) {
  ErrorBudget budget;
  budget.add(ErrorPart::jitter, 9);
  budget.add(ErrorPart::mesh, 16);
  EXPECT_NEAR(budget.half_width_95(), 1.96 * 5, 1e-12);
  EXPECT_NEAR(budget.half_width_95(ErrorPart::mesh), 1.96 * 4, 1e-12);
  EXPECT_EQ(budget.largest(), ErrorPart::mesh);
  EXPECT_EQ(budget.without(ErrorPart::mesh).largest(), ErrorPart::jitter);
  budget += budget;
  EXPECT_NEAR(budget.variance(), 50, 1e-12);
  budget *= 0.5;
  EXPECT_NEAR(budget.variance(ErrorPart::jitter), 9, 1e-12);
}

TEST(ErrorBudget, OfFewSamplesIsWider) {
  ErrorBudget four;
  four.add(ErrorPart::mesh, 1, 4);
  EXPECT_NEAR(four.half_width_95(), 2.7764, 1e-4) << "Student's t of 4 degrees of freedom";
  // Welch and Satterthwaite: (1 + 1)^2 / (1 / 4 + 1 / 2) = 16 / 3, t = 2.5224.
  four.add(ErrorPart::muscles, 1, 2);
  EXPECT_NEAR(four.half_width_95(), 2.5224 * std::sqrt(2), 2e-3);
  const double mesh = four.half_width_95(ErrorPart::mesh),
               muscles = four.half_width_95(ErrorPart::muscles);
  EXPECT_NEAR(std::hypot(mesh, muscles), four.half_width_95(), 1e-9);
  // A large stated part makes few samples of a small one harmless.
  four.add(ErrorPart::law, 1e4);
  EXPECT_NEAR(four.half_width_95(), 1.96 * 100.01, 0.02);
}

TEST(ErrorBudget, OfADifferenceIsItsFloor) {
  PairExcursion pair;
  pair.jitter_floor_mm = 0.3;
  pair.pose_floor_mm = 0.4;
  EXPECT_EQ(largest_part_of(pair), "head pose");
  EXPECT_NEAR(budget_of_difference(pair).half_width_95(), pair.floor_mm(), 1e-12);
  pair.mesh_floor_mm = 1.2;
  EXPECT_EQ(largest_part_of(pair), "mesh");
  EXPECT_NEAR(budget_of_difference(pair).half_width_95(), 1.3, 1e-12);
  Excursions all;
  all.pairs = {pair};
  all.pairs[0].left_side.excursion_mm = 1.4;
  all.pairs[0].judge();
  EXPECT_FALSE(all.pairs[0].undecided);
  add_repetition_floor(all, 1.5);
  EXPECT_TRUE(all.pairs[0].undecided);
  EXPECT_EQ(largest_part_of(all.pairs[0]), "repetition");
  EXPECT_NEAR(all.pairs[0].floor_mm(), std::hypot(1.3, 1.5), 1e-12);
  EXPECT_NEAR(budget_of_difference(all.pairs[0]).half_width_95(), all.pairs[0].floor_mm(), 1e-12);
  EXPECT_EQ(largest_part_of({}), "");
}

}  // namespace
}  // namespace hyperex::metrics
