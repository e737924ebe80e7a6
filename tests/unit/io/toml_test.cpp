// SPDX-License-Identifier: GPL-3.0-or-later
// The fault of toml++ that io/toml.hpp corrects: its test for spaces fails beyond ASCII.
#include "hyperex/io/toml.hpp"

#include <gtest/gtest.h>

#include <string>

namespace hyperex::io {
namespace {

TEST(Toml, LettersBeyondAsciiAreRefusedOutsideOfStrings) {
  for (const char* text : {"gr\u00f6\u00dfe = 2", "a = \u00e4", "a\u0299 = 1", "a = 5\"\uFCFF\"",
                           "\"\"\"#\"L\\\uFEE3element", "a = 1 \u3001"})
    EXPECT_THROW((void)toml::parse(text), toml::parse_error) << text;
}

TEST(Toml, LettersBeyondAsciiStayInStrings) {
  const toml::table table =
      toml::parse("\"\u00e4\" = '\u00f6' # \u00fc\na = \"\"\"x \\\n  \u00e4\uFCFF\"\"\"\n");
  EXPECT_EQ(table["\u00e4"].value<std::string>(), "\u00f6");
  EXPECT_EQ(table["a"].value<std::string>(), "x \u00e4\uFCFF");
}

}  // namespace
}  // namespace hyperex::io
