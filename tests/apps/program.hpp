// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The program as a user calls it: exit status, standard output and error kept apart, each test in
// a folder of its own.
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "hyperex/core/files.hpp"
#include "support/test_file.hpp"

namespace hyperex {

class ProgramTest : public testing::Test {
 protected:
  struct Outcome {
    int status;  ///< of the program; 128 + signal where one ended it, as the shell tells
    std::string out, err;
  };

  void SetUp() override { std::filesystem::create_directory(folder_ / "in"); }

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
  const TestFolder folder_;
};

}  // namespace hyperex
