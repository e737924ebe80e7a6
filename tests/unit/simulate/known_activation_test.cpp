// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/load/known_activation.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hyperex::simulate {
namespace {

TEST(KnownActivation, DiffersFromZeroWhereItsIntervalLeavesZeroOut) {
  EXPECT_TRUE(differs_from_zero(0.5, 0.25));
  EXPECT_FALSE(differs_from_zero(0.5, 0.26));
  EXPECT_TRUE(differs_from_zero(-0.5, 0.25)) << "below rest";
  EXPECT_FALSE(differs_from_zero(0, 0)) << "a palsy";
  EXPECT_FALSE(differs_from_zero(std::nan(""), 0.1));
  EXPECT_FALSE(differs_from_zero(0.5, std::nan("")));
}

}  // namespace
}  // namespace hyperex::simulate
