// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// The program as a user calls it, with exit status, standard output and error kept separate. Each
// test has its own folder.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "hyperex/core/files.hpp"
#include "support/test_file.hpp"

namespace hyperex {

inline std::vector<std::string> problems_in(const std::string& err) {
  std::vector<std::string> found;
  std::istringstream lines(err);
  for (std::string line; std::getline(lines, line);)
    if (line.rfind("hyperex: ", 0) == 0) found.push_back(line);
  return found;
}

inline std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    names.push_back(std::filesystem::relative(entry.path(), folder).string());
  std::sort(names.begin(), names.end());
  return names;
}

class ProgramTest : public testing::Test {
 protected:
  struct Outcome {
    int status;  ///< of the program; 128 + signal where a signal ended it, as in a shell
    std::string out, err;
  };

  void SetUp() override { std::filesystem::create_directory(folder_ / "in"); }

  /// `before`: a shell command that is run first, for example to set a limit.
  Outcome call(const std::string& arguments, const std::string& before = "true") const {
    const std::string command = "cd '" + (folder_ / "in").string() + "' && " + before + " && '" +
                                HYPEREX_PROGRAM "' " + arguments + " >../out.txt 2>../err.txt";
    const int status = std::system(command.c_str());
    return {WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status),
            read_file(folder_ / "out.txt"), read_file(folder_ / "err.txt")};
  }

  /// Runs a line of shell in the working folder, where $HYPEREX is the program; returns its exit
  /// status.
  int shell(const std::string& line) const {
    const std::string command =
        "cd '" + (folder_ / "in").string() + "' && HYPEREX='" HYPEREX_PROGRAM "' && " + line;
    const int status = std::system(command.c_str());
    return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  }

  /// A path in the working folder of the program.
  std::filesystem::path in(const std::string& name) const { return folder_ / "in" / name; }

  /// The summary of a run with `--out out`.
  nlohmann::json summary() const {
    return nlohmann::json::parse(read_file(in("out/summary.json")));
  }
  /// The sentence of a note of that run; empty where there is none.
  std::string text_of(const std::string& id) const {
    const auto remarks = summary()["remarks"];
    for (const auto& remark : remarks)
      if (remark["id"] == id) return remark["text"];
    return "";
  }

  /// The command is refused in one line that holds `words`, and nothing is changed.
  void expect_refused(const std::string& arguments, const std::string& words,
                      const std::string& before = "true") const {
    const auto names = names_in(in(""));
    const Outcome outcome = call(arguments, before);
    EXPECT_EQ(outcome.status, 2) << arguments << outcome.err;
    const auto reported = problems_in(outcome.err);
    ASSERT_EQ(reported.size(), 1u) << arguments << '\n' << outcome.err;
    EXPECT_THAT(reported[0], testing::HasSubstr(words)) << arguments;
    EXPECT_EQ(names_in(in("")), names) << arguments;
  }

 private:
  const TestFolder folder_;
};

}  // namespace hyperex
