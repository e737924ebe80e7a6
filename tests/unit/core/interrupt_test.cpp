// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/interrupt.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

#include "hyperex/core/files.hpp"
#include "hyperex/core/output_directory.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

class Interrupt : public testing::TestWithParam<int> {
 protected:
  // The child that dies is the program started anew: it receives its parent's folder.
  static constexpr const char* kFolder = "HYPEREX_INTERRUPT_TEST";

  void SetUp() override {
    testing::FLAGS_gtest_death_test_style = "threadsafe";
    const std::string own = testing::TempDir() + "hyperex_interrupt_" + std::to_string(::getpid());
    ::setenv(kFolder, own.c_str(), 0);
    folder_ = ::getenv(kFolder);
    fs::create_directories(folder_);
  }
  void TearDown() override {
    ::unsetenv(kFolder);
    fs::remove_all(folder_);
  }

  fs::path folder_;
};

TEST_P(Interrupt, RemovesWhatIsHalfWrittenAndKeepsWhatIsWhole) {
  const auto half_done = [&] {
    end_cleanly_when_interrupted();
    const auto none = [](const fs::path&) { return std::set<std::string>(); };
    OutputDirectory whole(folder_ / "whole", none);
    whole.commit();
    const OutputDirectory half(folder_ / "half", none);
    fs::create_directory(half.path() / "frames");
    std::ofstream(half.path() / "frames" / "frame.vtu") << "half";
    write_file_atomically(folder_ / "single.vtu", [&](std::ostream& stream) {
      stream << "half" << std::flush;
      std::raise(GetParam());
      for (;;) ::pause();
    });
  };
  EXPECT_EXIT(half_done(), testing::ExitedWithCode(128 + GetParam()), "^hyperex: interrupted; .*");
  int left = 0;
  for (const auto& entry : fs::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().filename(), "whole");
    ++left;
  }
  EXPECT_EQ(left, 1);
}

TEST_P(Interrupt, LeavesAnIgnoredSignalIgnored) {
  const auto ignoring = [] {
    std::signal(GetParam(), SIG_IGN);
    end_cleanly_when_interrupted();
    std::raise(GetParam());
    ::usleep(50000);
    ::_exit(7);
  };
  EXPECT_EXIT(ignoring(), testing::ExitedWithCode(7), "");
}

TEST_P(Interrupt, AtTheUsersRequestTheProgramGoesOnOnce) {
  const auto stopping = [] {
    end_cleanly_when_interrupted();
    {
      const StopOnRequest request;
      if (request.requested()) ::_exit(1);
      std::raise(GetParam());
      ::usleep(50000);
      if (!request.requested()) ::_exit(2);
      std::fputs("went on\n", stderr);
      if (::getenv("HYPEREX_INTERRUPT_TWICE") != nullptr)
        std::raise(GetParam());
      else
        wait_if_interrupted();  // returns
    }
    if (::getenv("HYPEREX_INTERRUPT_TWICE") != nullptr) wait_if_interrupted();
    ::_exit(9);
  };
  EXPECT_EXIT(stopping(), testing::ExitedWithCode(9), "went on");
  ::setenv("HYPEREX_INTERRUPT_TWICE", "1", 1);
  EXPECT_EXIT(stopping(), testing::ExitedWithCode(128 + GetParam()), "went on");
  ::unsetenv("HYPEREX_INTERRUPT_TWICE");
}

using AtExit = Interrupt;
TEST_P(AtExit, OfALibraryWhatIsHalfWrittenIsRemoved) {
  const auto ends = [&] {
    end_cleanly_when_interrupted();
    const TemporaryPath half(folder_ / "half");
    std::ofstream(half.path()) << "half";
    std::exit(5);
  };
  EXPECT_EXIT(ends(), testing::ExitedWithCode(5), "");
  EXPECT_TRUE(fs::is_empty(folder_));
}
INSTANTIATE_TEST_SUITE_P(Library, AtExit, testing::Values(0));

INSTANTIATE_TEST_SUITE_P(Signals, Interrupt, testing::Values(SIGINT, SIGTERM, SIGHUP, SIGQUIT));

}  // namespace
}  // namespace hyperex
