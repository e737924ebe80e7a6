// SPDX-License-Identifier: GPL-3.0-or-later
// An interrupted run leaves nothing behind.
#include <fcntl.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "apps/malformed.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

class Interrupted : public GoodInputs {
 protected:
  /// The program's status after it received `signal` in the middle of a run.
  int status_after(int signal) const {
    const std::string scene = in("scene.toml"), out = in("out"), err = in("err.txt");
    const pid_t program = ::fork();
    if (program == 0) {
      const int to = ::open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
      ::dup2(to, 1);
      ::dup2(to, 2);
      // This would run for minutes if not interrupted.
      ::execl(HYPEREX_PROGRAM, HYPEREX_PROGRAM, "run", scene.c_str(), "--out", out.c_str(), "--set",
              "time.step_s=3.1e-4", "--set", "time.end_s=600", nullptr);
      ::_exit(127);
    }
    const fs::path temporary = in(".out." + std::to_string(program) + ".tmp");
    for (int tries = 0; tries < 3000 && !fs::exists(temporary); ++tries)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    EXPECT_TRUE(fs::exists(temporary));
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
    ::kill(program, signal);
    int status = 0;
    ::waitpid(program, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  }
};

TEST_F(Interrupted, RunLeavesNothing) {
  const auto before = names_in(in(""));
  for (const int signal : {SIGINT, SIGTERM, SIGQUIT}) {
    EXPECT_EQ(status_after(signal), 128 + signal);
    const auto reported = problems_in(read_file(in("err.txt")));
    ASSERT_EQ(reported.size(), 1u);
    EXPECT_THAT(reported[0], testing::HasSubstr("interrupted"));
    fs::remove(in("err.txt"));
    EXPECT_EQ(names_in(in("")), before);
  }
}

TEST_F(Interrupted, WhatAKilledRunLeavesIsRemovedByTheNext) {
  EXPECT_EQ(status_after(SIGKILL), 128 + SIGKILL);
  const auto left = [&] {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(in("")))
      if (entry.path().filename().string().starts_with(".out.")) names.push_back(entry.path());
    return names;
  };
  EXPECT_EQ(left().size(), 1u);
  const Outcome next = call("run scene.toml --out out");
  EXPECT_EQ(next.status, 0) << next.err;
  EXPECT_THAT(next.err, testing::HasSubstr("which a killed run had left"));
  EXPECT_THAT(left(), testing::IsEmpty());
}

}  // namespace
}  // namespace hyperex
