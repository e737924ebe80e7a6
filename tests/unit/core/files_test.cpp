// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/files.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "hyperex/core/error.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

class Files : public ::testing::Test {
 protected:
  Files()
      : folder_(fs::temp_directory_path() /
                ("hyperex_core_" + std::to_string(::getpid()) + "_" +
                 ::testing::UnitTest::GetInstance()->current_test_info()->name())) {
    fs::create_directories(folder_);
  }
  ~Files() override { fs::remove_all(folder_); }

  static void put(const fs::path& file, const std::string& text) {
    write_file_atomically(file, [&](std::ostream& stream) { stream << text; });
  }
  std::vector<std::string> names() const {
    std::vector<std::string> found;
    for (const auto& entry : fs::directory_iterator(folder_))
      found.push_back(entry.path().filename().string());
    return found;
  }
  fs::path folder_;
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
  std::string what;
  try {
    put(folder_ / "big.txt", std::string(100000, 'x'));
  } catch (const InputError& error) {
    what = error.what();
  }
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

TEST_F(Files, OutputAppearsOnCommitOnly) {
  const fs::path target = folder_ / "deep" / "out";
  {
    OutputDirectory out(target);
    put(out.path() / "summary.json", "{}");
    EXPECT_FALSE(fs::exists(target));
    out.commit();
    EXPECT_EQ(read_file(target / "summary.json"), "{}");
  }
  EXPECT_TRUE(fs::exists(target / "summary.json"));
  {
    OutputDirectory out(target);  // an earlier run may be replaced ...
    put(out.path() / "new.txt", "x");
  }  // ... but is not, without commit
  EXPECT_TRUE(fs::exists(target / "summary.json"));
  {
    OutputDirectory out(target);
    put(out.path() / "new.txt", "x");
    out.commit();
  }
  EXPECT_FALSE(fs::exists(target / "summary.json"));
  EXPECT_TRUE(fs::exists(target / "new.txt"));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_ / "deep"), {}), 1);
}

TEST_F(Files, AnEarlierOutputSurvivesAFailedCommit) {
  const fs::path target = folder_ / "out";
  fs::create_directories(target);
  put(target / "summary.json", "earlier");
  {
    OutputDirectory out(target);
    fs::remove_all(out.path());  // as if the disk had gone: renaming fails
    EXPECT_THAT([&] { out.commit(); }, ThrowsMessage<InputError>(HasSubstr("cannot be written")));
  }
  EXPECT_EQ(read_file(target / "summary.json"), "earlier");
  EXPECT_THAT(names(), ::testing::ElementsAre("out"));
}

TEST_F(Files, OutputTakesNoForeignFolder) {
  fs::create_directories(folder_ / "mine");
  put(folder_ / "mine" / "letters.txt", "dear");
  EXPECT_THAT([&] { OutputDirectory out(folder_ / "mine"); },
              ThrowsMessage<InputError>(HasSubstr("holds other files")));
  put(folder_ / "file", "x");
  EXPECT_THAT([&] { OutputDirectory out(folder_ / "file"); },
              ThrowsMessage<InputError>(HasSubstr("is a file")));
  EXPECT_EQ(read_file(folder_ / "mine" / "letters.txt"), "dear");
  fs::create_directories(folder_ / "empty");
  {
    OutputDirectory out(folder_ / "empty/");
    put(out.path() / "summary.json", "{}");
    out.commit();
  }
  EXPECT_TRUE(fs::exists(folder_ / "empty" / "summary.json"));
}

TEST_F(Files, AnExceptionLeavesNoOutput) {
  try {
    OutputDirectory out(folder_ / "out");
    put(out.path() / "half.txt", "x");
    throw NumericalError("no positive pivot");
  } catch (const NumericalError&) {
  }
  EXPECT_THAT(names(), ::testing::IsEmpty());
}

}  // namespace
}  // namespace hyperex
