// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/progress.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <thread>
#include <vector>

#include "support/on_terminal.hpp"

namespace hyperex {
namespace {

std::string shown(int wait_ms) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("factor", 4);
    progress.update(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(wait_ms));
    progress.update(2);
    progress.update(3);
    EXPECT_GE(progress.seconds(), 1e-3 * wait_ms);
  }
  return ::testing::internal::GetCapturedStderr();
}

// This test comes first, since the others switch bars on.
TEST(Progress, ProgramsThatDoNotAskForBarsSeeNone) {
  EXPECT_EQ(shown(1050), "");
}

TEST(Progress, ShortWorkShowsNothing) {
  Progress::silence(false);
  EXPECT_EQ(shown(5), "");
}

TEST(Progress, LongWorkShowsOneLineUnderWayAndOneAtTheEnd) {
  Progress::silence(false);
  const std::string text = shown(1050);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2) << text;
  EXPECT_THAT(text, ::testing::HasSubstr(" 50 %"));
  EXPECT_THAT(text, ::testing::HasSubstr("100 %"));
}

TEST(Progress, WorkToldOfAtItsEndAloneShowsOneLine) {
  Progress::silence(false);
  ::testing::internal::CaptureStderr();
  {
    Progress progress("simulating", 2);
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
    progress.update(2);
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
  EXPECT_THAT(text, ::testing::HasSubstr("100 %"));
}

TEST(Progress, OneLongCallThatReportsNothingShowsOneLine) {
  Progress::silence(false);
  ::testing::internal::CaptureStderr();
  {
    const Progress progress("meshing", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(1050));
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1) << text;
}

TEST(Progress, OnATerminalTheSecondsGoOnWhereTheWorkReportsNothing) {
  Progress::silence(false);
  const std::string text = test::on_terminal([] {
    const Progress progress("measuring", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(2600));
  });
  // At the start, twice or more under way, at the end, and the end of the line.
  EXPECT_GE(std::count(text.begin(), text.end(), '\r'), 5) << text;
  EXPECT_THAT(text, ::testing::HasSubstr("    0.0 s"));
  EXPECT_THAT(text, ::testing::EndsWith(" s\r\n"));
}

TEST(Progress, OneLongCallThatReportsNothingIsTellingUnderWay) {
  Progress::silence(false);
  ::testing::internal::CaptureStderr();
  {
    const Progress progress("reading", 0);
    std::this_thread::sleep_for(std::chrono::milliseconds(4300));
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 3) << text;  // at 2 s, at 4 s, at the end
  EXPECT_THAT(text, ::testing::HasSubstr("...    2.0 s"));
  EXPECT_THAT(text, ::testing::HasSubstr("...    4.0 s"));
}

// A minute without a line looks like a program that hangs.
TEST(Progress, WithoutATerminalALineFollowsWithinTenSeconds) {
  using std::chrono::seconds;
  std::vector<long> at;
  for (seconds t = Progress::wait_after({}); t < seconds(60); t += Progress::wait_after(t))
    at.push_back(t.count());
  EXPECT_THAT(at, ::testing::ElementsAre(2, 4, 8, 16, 26, 36, 46, 56));
}

TEST(Progress, LongWorkThatReportsIsToldNowAndThen) {
  Progress::silence(false);
  ::testing::internal::CaptureStderr();
  {
    Progress progress("simulating", 100);
    for (int i = 0; i < 44; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(100));
      progress.update(i + 1);
    }
  }
  const std::string text = ::testing::internal::GetCapturedStderr();
  // After 1 s, 2 or 4 s and at the end; how far it was is said each time.
  EXPECT_GE(std::count(text.begin(), text.end(), '\n'), 3) << text;
  EXPECT_LE(std::count(text.begin(), text.end(), '\n'), 4) << text;
  EXPECT_THAT(text, ::testing::Not(::testing::HasSubstr("...")));
  EXPECT_THAT(text, ::testing::ContainsRegex(" [34][0-9] %    4.0 s"));
}

TEST(Progress, SilencedShowsNothing) {
  Progress::silence(true);
  const std::string text = shown(1050);
  Progress::silence(false);
  EXPECT_EQ(text, "");
}

}  // namespace
}  // namespace hyperex
