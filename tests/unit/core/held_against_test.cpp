// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/held_against.hpp"

#include <gtest/gtest.h>

namespace hyperex {
namespace {

void expect_words(const HeldAgainst& words, const std::string& own, const std::string& limit) {
  EXPECT_EQ(words.own, own);
  EXPECT_EQ(words.limit, limit);
}

TEST(HeldAgainst, OneDecimalWhereItSuffices) {
  expect_words(held_against(1.0, 1.04, 0.1), "1.0", "0.1");
  expect_words(held_against(-3.4, -3.447, 0.686), "3.4", "0.7");
}

// Corners of 9.655 and 10.124 mm are printed as 9.7 and 10.1.
TEST(HeldAgainst, MoreWhereTheComparisonWouldBeFalseAsPrinted) {
  expect_words(held_against(0.4, 0.468, 0.409), "0.47", "0.41");
  expect_words(held_against(0.7, 0.66, 0.7), "0.66", "0.70");
  expect_words(held_against(0.4, 0.4084, 0.4091), "0.408", "0.409");
}

TEST(HeldAgainst, ALimitIsNotPrintedAsNone) {
  expect_words(held_against(1.0, 1.0, 0.02), "1.00", "0.02");
  expect_words(held_against(1.0, 1.0, 0), "1.0", "0.0");
}

// 10.052 and 5.947 are printed as 10.1 and 5.9; the exact difference would be printed as 4.1.
TEST(PrintedChange, IsTheDifferenceOfThePrintedLengths) {
  EXPECT_NEAR(printed_change_mm(10.052, 5.947), -4.2, 1e-12);
  EXPECT_NEAR(printed_change_mm(8.26, 6.24), -2.1, 1e-12);
  EXPECT_EQ(printed_change_mm(9.64, 9.66), 0) << "less than half of the last digit";
  EXPECT_DOUBLE_EQ(printed_mm(10.052), 10.1);
}

TEST(HeldAgainst, EqualOnesAreThreeDecimalsAtMost) {
  expect_words(held_against(0.4, 0.4, 0.4), "0.400", "0.400");
}

}  // namespace
}  // namespace hyperex
