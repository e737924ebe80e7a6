// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The program as a user calls it: exit status, standard output and error kept apart, each test in
// a folder of its own.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "hyperex/core/files.hpp"

namespace hyperex {

class ProgramTest : public testing::Test {
 protected:
  struct Outcome {
    int status;  ///< of the program; 128 + signal where one ended it, as the shell tells
    std::string out, err;
  };

  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + "." + test->name();
    std::replace(name.begin(), name.end(), '/', '.');
    folder_ = std::filesystem::path(testing::TempDir()) /
              ("hyperex_apps_" + std::to_string(::getpid()) + "_" + name);
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_ / "in");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// `before` is said to the shell first: a limit, say.
  Outcome call(const std::string& arguments, const std::string& before = "true") const {
    const std::string command = "cd '" + (folder_ / "in").string() + "' && " + before + " && '" +
                                HYPEREX_PROGRAM "' " + arguments + " >../out.txt 2>../err.txt";
    const int status = std::system(command.c_str());
    return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
            read_file(folder_ / "out.txt"), read_file(folder_ / "err.txt")};
  }

  /// A line of shell where the program is called, which is $HYPEREX there; its exit status.
  int shell(const std::string& line) const {
    const std::string command =
        "cd '" + (folder_ / "in").string() + "' && HYPEREX='" HYPEREX_PROGRAM "' && " + line;
    const int status = std::system(command.c_str());
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

  /// Where the program is called.
  std::filesystem::path in(const std::string& name) const { return folder_ / "in" / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace hyperex
