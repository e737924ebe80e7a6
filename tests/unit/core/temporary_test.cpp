// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/temporary.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <vector>

#include "support/test_file.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

class Temporary : public ::testing::Test {
 protected:
  /// The number of a process that has been and gone.
  static long gone() {
    const pid_t child = ::fork();
    if (child == 0) ::_exit(0);
    ::waitpid(child, nullptr, 0);
    return child;
  }
  fs::path put(const std::string& name) const {
    std::ofstream(folder_ / name) << "x";
    return folder_ / name;
  }

  const TestFolder folder_;
};

TEST_F(Temporary, OnlyWhatAGoneProcessLeftOfThisTargetIsRemoved) {
  const std::string dead = std::to_string(gone()), own = std::to_string(::getpid());
  std::vector<fs::path> left, kept;
  for (const char* ending : {".tmp", ".tmp.mp4", ".tmp.going", ".old"})
    left.push_back(put(".out." + dead + ending));
  left.push_back(folder_ / (".out." + dead + ".tmp.folder"));
  fs::create_directories(left.back() / "frames");
  put("out");
  for (const std::string& name : std::vector<std::string>{
           ".out." + own + ".tmp", ".other." + dead + ".tmp", ".out." + dead + ".doc",
           ".out.12a.tmp", ".out.tmp", "out." + dead + ".tmp", ".out." + dead + ".tmpfile",
           ".out.-1.tmp", ".out.0.tmp"})
    kept.push_back(put(name));
  remove_leftovers(folder_ / "out", folder_);
  for (const fs::path& path : left) EXPECT_FALSE(fs::exists(path)) << path;
  for (const fs::path& path : kept) EXPECT_TRUE(fs::exists(path)) << path;
}

TEST_F(Temporary, WhatALivingProcessUsesStays) {
  // Files of a process of this program, of another program, and of a process that cannot be found
  // by its number but holds a lock.
  const pid_t same = ::fork();
  if (same == 0)
    for (;;) ::pause();
  const pid_t another = ::fork();
  if (another == 0) {
    ::execlp("sleep", "sleep", "60", nullptr);
    ::_exit(1);
  }
  for (int tries = 0; tries < 200; ++tries) {
    std::error_code error;
    if (fs::read_symlink("/proc/" + std::to_string(another) + "/exe", error) !=
        fs::read_symlink("/proc/self/exe", error))
      break;
    ::usleep(10000);
  }
  const auto used = put(".out." + std::to_string(same) + ".tmp");
  const auto left = put(".out." + std::to_string(another) + ".tmp");  // a number given again
  const auto locked = put(".out." + std::to_string(gone()) + ".tmp");
  {
    const InUse lock(locked);
    EXPECT_TRUE(lock.held());
    EXPECT_TRUE(InUse(locked).taken());
    remove_leftovers(folder_ / "out", folder_);
    EXPECT_TRUE(fs::exists(used));
    EXPECT_TRUE(fs::exists(locked));
    EXPECT_FALSE(fs::exists(left));
  }
  for (const pid_t child : {same, another}) {
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  remove_leftovers(folder_ / "out", folder_);
  EXPECT_FALSE(fs::exists(used));
  EXPECT_FALSE(fs::exists(locked));
}

TEST_F(Temporary, AnOutputThatWasMovedAsideComesBack) {
  put(".out." + std::to_string(gone()) + ".old");
  remove_leftovers(folder_ / "out", folder_);
  EXPECT_TRUE(fs::exists(folder_ / "out"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(Temporary, NamesOfAnyLengthAreToldApart) {
  const std::string start(250, 'n');
  const fs::path a = temporary_beside(folder_ / (start + "a")),
                 b = temporary_beside(folder_ / (start + "b"));
  EXPECT_NE(a, b);
  EXPECT_LE(a.filename().string().size(), 249u);
  EXPECT_TRUE(is_temporary_of(folder_ / (start + "a"), a.filename().string()));
  EXPECT_FALSE(is_temporary_of(folder_ / (start + "b"), a.filename().string()));
  std::string umlauts;
  for (int i = 0; i < 125; ++i) umlauts += "\u00fc";
  for (const std::string more : {"", "x"}) {
    const std::string name = temporary_beside(folder_ / (more + umlauts)).filename().string();
    const auto hash = name.find('~');
    ASSERT_NE(hash, std::string::npos);
    EXPECT_EQ(name.substr(hash - 2, 2), "\u00fc") << "cut between characters";
  }
  EXPECT_EQ(temporary_within("some/out").string(),
            "some/out/.out." + std::to_string(::getpid()) + ".tmp");
}

}  // namespace
}  // namespace hyperex
