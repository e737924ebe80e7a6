// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/error.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace hyperex {
namespace {

TEST(InputProblem, SentenceNamesFileLineKeyValueAndRange) {
  const InputProblem problem{"scene.toml", 12, "time.step_s", "-1", "a number above 0 (s)"};
  EXPECT_EQ(problem.sentence(), "scene.toml:12: time.step_s = -1: expected a number above 0 (s)");
}

TEST(InputProblem, SentenceWithoutItsParts) {
  EXPECT_EQ((InputProblem{"a.json", 0, "units", "", "\"mm\""}.sentence()),
            "a.json: units: expected \"mm\"");
  EXPECT_EQ((InputProblem{"a.csv", 3, "", "x", "a number"}.sentence()),
            "a.csv:3: x: expected a number");
  EXPECT_EQ((InputProblem{"", 0, "dt", "0", "more"}.sentence()), "dt = 0: expected more");
  EXPECT_EQ((InputProblem{"", 0, "", "", "a face"}.sentence()), "expected a face");
}

TEST(InputError, OneLineAProblem) {
  const std::vector<InputProblem> problems{{"s.toml", 1, "a", "1", "2"},
                                           {"s.toml", 2, "b", "3", "4"}};
  EXPECT_STREQ(InputError(problems).what(),
               "s.toml:1: a = 1: expected 2\ns.toml:2: b = 3: expected 4");
  EXPECT_STREQ(InputError("scan.ply", "is torn").what(), "scan.ply: is torn");
  EXPECT_STREQ(InputError({"", 14, "a", "1", "2"}).what(), "a = 1: expected 2")
      << "no file, no line";
}

TEST(InputError, KeepsItsProblems) {
  const InputError error(
      std::vector<InputProblem>{{"s.toml", 1, "a", "1", "2"}, {"s.toml", 2, "b", "3", "4"}});
  const InputError copy = error;
  ASSERT_EQ(copy.problems().size(), 2u);
  EXPECT_EQ(copy.problems()[1].key, "b");
  EXPECT_EQ(InputError({"s.toml", 1, "a", "1", "2"}).problems().size(), 1u);
  EXPECT_TRUE(InputError("a sentence").problems().empty());
  EXPECT_TRUE(InputError("scan.ply", "is torn").problems().empty());
}

TEST(InputError, TellsTheFirstTwentyProblemsAndHowManyMore) {
  const std::vector<InputProblem> problems(20000, {"s.toml", 1, "a", "1", "2"});
  const std::string what = InputError(problems).what();
  EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 20);
  EXPECT_TRUE(what.ends_with("expected 2\n... and 19980 problems more")) << what;
}

TEST(InputError, KeepsLongNamesAndControlCharactersOutOfTheTerminal) {
  const std::string what =
      InputError({"s.toml", 1, std::string(10'000'000, 'k'), "\x1b[31mred", "2"}).what();
  EXPECT_LT(what.size(), 300u);
  EXPECT_TRUE(what.ends_with("... = \\x1b[31mred: expected 2")) << what;
  EXPECT_EQ((InputProblem{"a.wfm", 0, "", "", "unit \x01"}.sentence()),
            "a.wfm: expected unit \\x01");
  EXPECT_LT(std::string(InputError("s.toml", std::string(100000, 'x')).what()).size(), 1000u);
}

}  // namespace
}  // namespace hyperex
