// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/printable.hpp"

#include <gtest/gtest.h>

namespace hyperex {
namespace {

TEST(Printable, ShowsControlCharactersAndKeepsTheRest) {
  EXPECT_EQ(printable("a\x1b[31m\tb\x7f"), "a\\x1b[31m\\x09b\\x7f");
  EXPECT_EQ(printable(std::string("a\0b", 3)), "a\\x00b");
  EXPECT_EQ(printable("Käse,\n\"naïve\""), "Käse,\n\"naïve\"");
}

TEST(Printable, CutsEachLineBetweenCharacters) {
  EXPECT_EQ(printable("abcdef\nghi", 4), "abcd...\nghi");
  EXPECT_EQ(printable("äöüß", 3), "äöü...");
  EXPECT_EQ(printable("äöü", 3), "äöü");
}

TEST(Printable, KeepsTheFirstLines) {
  EXPECT_EQ(first_lines("a\nb\nc", 3), "a\nb\nc");
  EXPECT_EQ(first_lines("a\nb\nc\nd\ne", 3), "a\nb\nc\n... and 2 lines more");
  EXPECT_EQ(first_lines(""), "");
}

}  // namespace
}  // namespace hyperex
