// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/files.hpp"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <new>
#include <string>

#include "hyperex/core/error.hpp"
#include "support/refusal.hpp"
#include "support/sanitizers.hpp"
#include "support/test_file.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Files : public ::testing::Test {
 protected:
  static void put(const fs::path& file, const std::string& text) {
    write_file_atomically(file, [&](std::ostream& stream) { stream << text; });
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_))
      found.push_back(entry.path().filename().string());
    return found;
  }
  const TestFolder folder_;
};

TEST_F(Files, WrittenWholeAndReplaced) {
  put(folder_ / "a.txt", std::string("one\0two\n", 8));
  EXPECT_EQ(read_file(folder_ / "a.txt"), std::string("one\0two\n", 8));
  put(folder_ / "a.txt", "again");
  EXPECT_EQ(read_file(folder_ / "a.txt"), "again");
  EXPECT_THAT(names(), ::testing::ElementsAre("a.txt"));
}

TEST_F(Files, AFailingWriterLeavesTheOldFileAlone) {
  put(folder_ / "a.txt", "old");
  EXPECT_THROW(write_file_atomically(folder_ / "a.txt",
                                     [](std::ostream& stream) {
                                       stream << "half";
                                       throw std::runtime_error("no more");
                                     }),
               std::runtime_error);
  EXPECT_EQ(read_file(folder_ / "a.txt"), "old");
  EXPECT_THAT(names(), ::testing::ElementsAre("a.txt"));
}

TEST_F(Files, NoFolderIsAnInputError) {
  EXPECT_THAT([&] { put(folder_ / "none" / "a.txt", "x"); },
              ThrowsMessage<InputError>(HasSubstr("cannot be written")));
  EXPECT_THAT(names(), ::testing::IsEmpty());
}

TEST_F(Files, AFullDiskLeavesNothing) {
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tiny{1000, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tiny), 0);
  const std::string what =
      test::refusal([&] { put(folder_ / "big.txt", std::string(100000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_THAT(what, HasSubstr("cannot be written"));
  EXPECT_THAT(names(), ::testing::IsEmpty());
}

TEST_F(Files, ReadingNamesWhatIsWrong) {
  EXPECT_THAT([&] { read_file(folder_ / "none"); },
              ThrowsMessage<InputError>(HasSubstr("no such file")));
  EXPECT_THAT([&] { read_file(folder_); }, ThrowsMessage<InputError>(HasSubstr("is a folder")));
  put(folder_ / "empty", "");
  EXPECT_EQ(read_file(folder_ / "empty"), "");
}

TEST_F(Files, AreReadWholeOrNotAtAll) {
#if HYPEREX_SANITIZED
  GTEST_SKIP() << "a sanitizer takes more addresses than any limit leaves";
#endif
  constexpr std::size_t size = std::size_t(1) << 30;
  put(folder_ / "large", "");
  fs::resize_file(folder_ / "large", size);  // takes no room on the disk
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  const rlimit tight{size, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_AS, &tight), 0);
  EXPECT_THROW(read_file(folder_ / "large"), std::bad_alloc);
  ::setrlimit(RLIMIT_AS, &before);
}

TEST_F(Files, WhoseSizeIsNotStatedAreReadToTheEnd) {
  std::ifstream stream("/proc/self/maps");
  std::string line, last;
  while (std::getline(stream, line)) last = line;
  EXPECT_THAT(read_file("/proc/self/maps"), HasSubstr(last + "\n"));
}

TEST_F(Files, ALinkIsFollowedAndPermissionsAreKept) {
  fs::create_directories(folder_ / "disk");
  put(folder_ / "disk" / "a.txt", "old");
  fs::permissions(folder_ / "disk" / "a.txt", fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("disk/a.txt", folder_ / "link.txt");
  put(folder_ / "link.txt", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.txt"));
  EXPECT_EQ(read_file(folder_ / "disk" / "a.txt"), "new");
  EXPECT_EQ(fs::status(folder_ / "disk" / "a.txt").permissions(),
            fs::perms::owner_read | fs::perms::owner_write);
  fs::create_symlink("disk/b.txt", folder_ / "to_come.txt");
  put(folder_ / "to_come.txt", "b");
  EXPECT_EQ(read_file(folder_ / "disk" / "b.txt"), "b");
  fs::create_symlink("circle", folder_ / "circle");
  EXPECT_THAT([&] { put(folder_ / "circle", "x"); },
              ThrowsMessage<InputError>(HasSubstr("circle")));
  EXPECT_THAT([&] { put(folder_ / "disk", "x"); },
              ThrowsMessage<InputError>(HasSubstr("is a folder")));
}

TEST_F(Files, WhatIsNoRegularFileIsWrittenToAndStays) {
  const fs::path pipe = folder_ / "pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
  put(pipe, "through");
  char got[20] = {};
  EXPECT_EQ(::read(reader, got, sizeof got), 7);
  ::close(reader);
  EXPECT_STREQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(pipe));
  fs::create_symlink("/dev/full", folder_ / "full");
  EXPECT_THAT([&] { put(folder_ / "full", "x"); },
              ThrowsMessage<InputError>(HasSubstr("No space left")));
  EXPECT_TRUE(fs::is_symlink(folder_ / "full"));
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Files, ALongNameHasAShorterTemporaryOne) {
  const fs::path file = folder_ / (std::string(251, 'a') + ".txt");
  put(file, "x");
  EXPECT_EQ(read_file(file), "x");
}

TEST_F(Files, OutputsAreCheckedBeforeTheWork) {
  put(folder_ / "scan.ply", "scan");
  fs::create_hard_link(folder_ / "scan.ply", folder_ / "same.ply");
  fs::create_symlink("scan.ply", folder_ / "link.ply");
  const auto refused = [&](const std::vector<fs::path>& outputs, const char* why) {
    EXPECT_THAT(
        [&] {
          check_outputs(outputs, {folder_ / "scan.ply", ""});
        },
        ThrowsMessage<InputError>(HasSubstr(why)));
  };
  const fs::path out = folder_ / "out.csv", round = folder_ / "." / "out.csv";
  for (const char* name : {"scan.ply", "same.ply", "link.ply"})
    refused({folder_ / name}, "is read too");
  refused({out, "", round}, "is named for two outputs");
  refused({folder_ / "none" / "a.csv"}, "there is no folder");
  refused({folder_}, "is a folder");
  EXPECT_NO_THROW(check_outputs({out, "", folder_ / "b.csv"}, {folder_ / "scan.ply"}));
  EXPECT_NO_THROW(check_outputs({"/dev/null", "/dev/null"}, {"/dev/null"}));
}

}  // namespace
}  // namespace hyperex
