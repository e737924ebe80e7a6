// SPDX-License-Identifier: GPL-3.0-or-later
// Standard streams that are closed, full, or no longer read.
#include <fstream>

#include "apps/malformed.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class ClosedStreams : public GoodInputs, public testing::WithParamInterface<const char*> {};

TEST_P(ClosedStreams, DoNotDisturbARun) {
  const std::string closed = GetParam();
  EXPECT_EQ(shell("$HYPEREX run scene.toml --out out " + closed), 0);
  EXPECT_TRUE(fs::exists(in("out/summary.json")));
  EXPECT_EQ(shell("$HYPEREX presets " + closed), 0);
}

INSTANTIATE_TEST_SUITE_P(Some, ClosedStreams,
                         testing::Values("<&- >/dev/null 2>&-", "</dev/null >&- 2>&-",
                                         "<&- >&- 2>err.txt", "<&- >&- 2>&-"),
                         [](const auto& which) { return std::to_string(which.index); });

class FullOutput : public GoodInputs, public testing::WithParamInterface<const char*> {};

TEST_P(FullOutput, IsToldAndIsNoSuccess) {
  const auto before = names_in(in(""));
  EXPECT_EQ(shell("$HYPEREX " + std::string(GetParam()) + " >/dev/full 2>err.txt"), 1);
  const auto reported = problems_in(read_file(in("err.txt")));
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_THAT(reported[0], HasSubstr("standard output: the results could not be printed ("));
  fs::remove(in("err.txt"));
  EXPECT_EQ(names_in(in("")), before);
}

INSTANTIATE_TEST_SUITE_P(Of, FullOutput,
                         testing::Values("presets", "scene-reference", "check scene.toml",
                                         "compare face.ply face.ply --unit mm --json",
                                         "symmetry motion.csv --keep-head", "--help", "--version",
                                         "run --help"),
                         [](const auto& which) { return std::to_string(which.index); });

class ReaderLeaves : public GoodInputs {};

TEST_F(ReaderLeaves, NoReasonToEndTheRun) {
  EXPECT_EQ(shell("($HYPEREX run scene.toml --out out; echo $? >status) 2>&1 | head -n 0; "
                  "while ! [ -s status ]; do sleep 0.1; done"),
            0);
  EXPECT_NE(read_file(in("status")), "141\n");
  EXPECT_TRUE(fs::exists(in("out/summary.json")));
  for (const auto& entry : fs::directory_iterator(in("")))
    EXPECT_FALSE(entry.path().filename().string().starts_with(".out")) << entry.path();
}

TEST_F(ReaderLeaves, APipeThatEndsEarlyIsNoSuccessAndNoWord) {
  EXPECT_EQ(shell("(sleep 0.2; $HYPEREX presets 2>err.txt; echo $? >status) | true; "
                  "while ! [ -s status ]; do sleep 0.1; done"),
            0);
  EXPECT_EQ(read_file(in("status")), "1\n");
  EXPECT_EQ(read_file(in("err.txt")), "");
}

}  // namespace
}  // namespace hyperex
