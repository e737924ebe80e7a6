// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/assert.hpp"

#include <gtest/gtest.h>

#include "hyperex/core/quantile.hpp"

namespace hyperex {
namespace {

TEST(AssertDeathTest, FiresInEveryBuildAndNamesTheCondition) {
  const int two = 2;
  EXPECT_DEATH(HX_ASSERT(two == 3),
               "assert_test.cpp:[0-9]+: .*: bug in hyperex: two == 3 does not");
}

TEST(AssertDeathTest, FiresInAnInlineFunction) {
  EXPECT_DEATH(median({}), "quantile.hpp:[0-9]+: .*bug in hyperex");
}

TEST(Assert, PassesWhatHoldsAndEvaluatesItOnce) {
  int calls = 0;
  HX_ASSERT(++calls == 1);
  EXPECT_EQ(calls, 1);
}

}  // namespace
}  // namespace hyperex
