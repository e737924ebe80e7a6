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

TEST(Printable, ShowsWhatIsNoUtf8AndTheControlsOfC1) {
  EXPECT_EQ(printable("caf\xe9.ply"), "caf\\xe9.ply");
  EXPECT_EQ(printable("a\xc2\x9b"
                      "31m"),
            "a\\xc2\\x9b31m");
  EXPECT_EQ(printable("\xed\xa0\x80\xf5"), "\\xed\\xa0\\x80\\xf5");
  EXPECT_TRUE(is_utf8("Käse \xf0\x9f\x98\x80"));
  EXPECT_TRUE(is_utf8(""));
  for (const char* wrong :
       {"\xe9", "\xc3", "\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "a\x80"})
    EXPECT_FALSE(is_utf8(wrong)) << printable(wrong);
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
