// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/kept_results.hpp"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <thread>

#include "support/test_file.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;

class Kept : public testing::Test {
 protected:
  const TestFolder folder;
};

TEST_F(Kept, IsFoundAgainByteForByte) {
  const KeptResults kept(folder / "deeper");
  const std::string bytes("a\0b\n\xff", 5);
  EXPECT_FALSE(kept.find("one"));
  kept.keep("one", bytes);
  kept.keep("none", "");
  EXPECT_EQ(kept.find("one"), bytes);
  EXPECT_EQ(kept.find("none"), "");
  EXPECT_FALSE(kept.find("two"));
  EXPECT_FALSE(KeptResults().find("one"));
}

TEST_F(Kept, WhatIsTornOrChangedCountsAsAbsentAndIsReplaced) {
  const KeptResults kept(folder);
  kept.keep("one", "some bytes");
  const fs::path file = folder / "one.kept";
  ASSERT_TRUE(fs::exists(file));
  fs::resize_file(file, fs::file_size(file) - 1);
  EXPECT_FALSE(kept.find("one"));
  fs::resize_file(file, 10);
  EXPECT_FALSE(kept.find("one"));
  kept.keep("one", "some bytes");
  std::fstream(file, std::ios::in | std::ios::out | std::ios::binary).seekp(66) << 'X';
  EXPECT_FALSE(kept.find("one"));
  kept.keep("one", "others");
  EXPECT_EQ(kept.find("one"), "others");
}

TEST_F(Kept, IsForItsOwnerAloneFromCreationOn) {
  const mode_t before = ::umask(0);  // what the user's shell would allow everybody
  const KeptResults kept(folder / "cache" / "deeper");
  kept.keep("one", "a face");
  ::umask(before);
  const auto mode = [](const fs::path& path) {
    return fs::status(path).permissions() & fs::perms::all;
  };
  EXPECT_EQ(mode(folder / "cache"), fs::perms::owner_all);
  EXPECT_EQ(mode(folder / "cache" / "deeper"), fs::perms::owner_all);
  EXPECT_EQ(mode(folder / "cache" / "deeper" / "one.kept"),
            fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(Kept, AFolderThatOthersMayEnterIsClosedToThem) {
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::all);
  KeptResults(folder).keep("one", "a face");
  EXPECT_EQ(fs::status(folder).permissions() & fs::perms::all, fs::perms::owner_all);
  EXPECT_TRUE(KeptResults(folder).find("one"));
}

TEST_F(Kept, WhatOthersMayWriteIsPassedOver) {
  const KeptResults kept(folder);
  const fs::path file = folder / "one.kept";
  kept.keep("one", "a face");
  ASSERT_TRUE(kept.find("one"));
  for (const fs::path& path : {file, folder.path()}) {
    const fs::perms good = fs::status(path).permissions();
    for (const fs::perms wrong : {fs::perms::group_write, fs::perms::others_write}) {
      fs::permissions(path, wrong, fs::perm_options::add);
      EXPECT_FALSE(kept.find("one")) << path;
      fs::permissions(path, good);
    }
  }
  EXPECT_TRUE(kept.find("one"));
  if (::geteuid() != 0) return;  // only root can give files away
  for (const fs::path& path : {file, folder.path()}) {
    ASSERT_EQ(::chown(path.c_str(), 65534, 65534), 0);
    EXPECT_FALSE(kept.find("one")) << path;
    ASSERT_EQ(::chown(path.c_str(), 0, 0), 0);
  }
}

TEST_F(Kept, AnEntryStandsForNoOtherAndIsNoLink) {
  const KeptResults kept(folder);
  kept.keep("one", "a face");
  fs::copy_file(folder / "one.kept", folder / "two.kept");
  EXPECT_FALSE(kept.find("two"));
  fs::rename(folder / "one.kept", folder / "elsewhere");
  fs::create_symlink(folder / "elsewhere", folder / "one.kept");
  EXPECT_FALSE(kept.find("one"));
}

TEST_F(Kept, TheOldestGoWhereTheBoundIsPassed) {
  const KeptResults kept(folder, 1000);
  const std::string bytes(250, 'x');  // with its checksum 314
  for (const char* key : {"a", "b", "c"}) {
    kept.keep(key, bytes);
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_TRUE(kept.find("a"));  // used: no longer the oldest
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  kept.keep("d", bytes);
  EXPECT_TRUE(kept.find("a"));
  EXPECT_FALSE(kept.find("b"));
  EXPECT_TRUE(kept.find("c"));
  EXPECT_TRUE(kept.find("d"));
  kept.keep("large", std::string(2000, 'x'));
  EXPECT_FALSE(kept.find("large"));
  EXPECT_TRUE(kept.find("d"));
}

TEST_F(Kept, WhereNothingCanBeWrittenThereIsSimplyNone) {
  fs::create_directories(folder);
  std::ofstream(folder / "file") << "in the way";
  const KeptResults kept(folder / "file" / "below");
  kept.keep("one", "bytes");
  EXPECT_FALSE(kept.find("one"));
  EXPECT_TRUE(fs::is_regular_file(folder / "file"));
}

TEST_F(Kept, LeavesNoOtherFiles) {
  const KeptResults kept(folder);
  std::vector<std::thread> writers;
  for (int i = 0; i < 4; ++i)
    writers.emplace_back([&, i] { kept.keep("key" + std::to_string(i), std::string(10000, 'x')); });
  for (auto& writer : writers) writer.join();
  for (const auto& entry : fs::directory_iterator(folder))
    EXPECT_EQ(entry.path().extension(), ".kept");
  for (int i = 0; i < 4; ++i) EXPECT_TRUE(kept.find("key" + std::to_string(i)));
}

TEST(UserCacheFolder, IsWhereTheDesktopSaysOrInTheHome) {
  const auto value = [](const char* name) { return std::string(std::getenv(name) ?: ""); };
  const std::string cache = value("XDG_CACHE_HOME"), home = value("HOME");
  setenv("XDG_CACHE_HOME", "/tmp/cache", 1);
  EXPECT_EQ(user_cache_folder(), "/tmp/cache/hyperex");
  setenv("XDG_CACHE_HOME", "not/absolute", 1);
  setenv("HOME", "/home/somebody", 1);
  EXPECT_EQ(user_cache_folder(), "/home/somebody/.cache/hyperex");
  unsetenv("XDG_CACHE_HOME");
  unsetenv("HOME");
  EXPECT_TRUE(user_cache_folder().empty());
  if (!cache.empty()) setenv("XDG_CACHE_HOME", cache.c_str(), 1);
  if (!home.empty()) setenv("HOME", home.c_str(), 1);
}

}  // namespace
}  // namespace hyperex
