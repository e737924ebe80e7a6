// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/size_text.hpp"

#include <gtest/gtest.h>

namespace hyperex {
namespace {

TEST(SizeText, StatesEverySizeByTwoDigitsOrMore) {
  EXPECT_EQ(size_text(2.51e10), "25 GB");
  EXPECT_EQ(size_text(1.254e9), "1.25 GB");
  EXPECT_EQ(size_text(2.5e8), "0.25 GB");
}

TEST(SizeText, NeverSaysZero) {
  EXPECT_EQ(size_text(48e6), "48 MB");
  EXPECT_EQ(size_text(1e6), "1 MB");
  EXPECT_EQ(size_text(999999), "less than 1 MB");
  EXPECT_EQ(size_text(0), "less than 1 MB");
}

}  // namespace
}  // namespace hyperex
