// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/output_directory.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "hyperex/core/error.hpp"
#include "hyperex/core/files.hpp"
#include "support/test_file.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

/// In these tests a run lists its files in "list", one name per line.
std::set<std::string> listed(const fs::path& folder) {
  std::set<std::string> names;
  std::ifstream lines(folder / "list");
  for (std::string line; std::getline(lines, line);) names.insert(line);
  return names;
}

class OutputFolder : public ::testing::Test {
 protected:
  ~OutputFolder() override { fs::current_path(before_); }

  static void put(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  static void fill(const OutputDirectory& out, const std::string& text) {
    put(out.path() / "table.csv", text);
    put(out.path() / "frames" / "0.vtu", text);
    put(out.path() / "list", "list\ntable.csv\nframes/0.vtu\n");
  }
  static void run(const fs::path& target, const std::string& text = "new") {
    OutputDirectory out(target, listed);
    fill(out, text);
    out.commit();
  }
  std::vector<std::string> names() const { return files_below(folder_); }
  static void expect_refused(const fs::path& target, const std::string& why) {
    EXPECT_THAT([&] { OutputDirectory out(target, listed); },
                ThrowsMessage<InputError>(HasSubstr(why)));
  }

  const fs::path before_ = fs::current_path();
  const TestFolder folder_;
};

TEST_F(OutputFolder, IsNotNamedAsAFileIs) {
  for (const char* name : {"face.glb", "new/report.HTML"})
    expect_refused(folder_ / name, "is named as a file is; expected the name of a folder");
  EXPECT_TRUE(names().empty());
  EXPECT_NO_THROW(run(folder_ / "version 1.2"));
  fs::create_directory(folder_ / "there.glb");
  EXPECT_NO_THROW(run(folder_ / "there.glb")) << "a folder of that name is one";
}

TEST_F(OutputFolder, AppearsOnCommitOnly) {
  const fs::path target = folder_ / "deep" / "out";
  {
    OutputDirectory out(target, listed);
    fill(out, "1");
    EXPECT_FALSE(fs::exists(target));
  }
  EXPECT_TRUE(fs::is_empty(folder_)) << "the parent that was made for it is gone too";
  run(target, "1");
  EXPECT_EQ(read_file(target / "table.csv"), "1");
  {
    OutputDirectory out(target, listed);
    fill(out, "2");
  }
  EXPECT_EQ(read_file(target / "table.csv"), "1");
  run(target, "2");
  EXPECT_THAT(names(), ElementsAre("deep/out/frames/0.vtu", "deep/out/list", "deep/out/table.csv"));
  EXPECT_EQ(read_file(target / "table.csv"), "2");
}

TEST_F(OutputFolder, FilesThatNoRunWroteAreNamedAndStay) {
  const fs::path out = folder_ / "out";
  run(out, "old");
  put(out / "thesis.doc", "x");
  expect_refused(out, "holds thesis.doc, which no earlier run");
  put(out / "frames" / "mine.txt", "x");
  fs::create_directory(out / "notes");
  expect_refused(out, "holds frames/mine.txt, notes/ and thesis.doc, which no");
  fs::create_symlink("thesis.doc", out / "a_link");
  put(out / "new\nline", "x");
  expect_refused(out, "holds a_link, frames/mine.txt, new?line and 2 more, which no");
  EXPECT_EQ(read_file(out / "table.csv"), "old");
  EXPECT_TRUE(fs::exists(out / "thesis.doc"));
  EXPECT_THAT(fs::exists(out / "notes"), true);
}

TEST_F(OutputFolder, AFolderWithoutAListIsNobodysButTheUsers) {
  put(folder_ / "mine" / "table.csv", "dear");
  expect_refused(folder_ / "mine", "holds table.csv");
  put(folder_ / "file", "x");
  expect_refused(folder_ / "file", "is a file");
  expect_refused("", "is empty");
  fs::create_directories(folder_ / "empty");
  run(folder_ / "empty/");
  EXPECT_TRUE(fs::exists(folder_ / "empty" / "table.csv"));
}

TEST_F(OutputFolder, ALinkWhereAFileOrFolderWasWrittenIsTheUsers) {
  const fs::path out = folder_ / "out";
  run(out);
  fs::rename(out / "frames", folder_ / "moved");
  fs::create_symlink(folder_ / "moved", out / "frames");
  expect_refused(out, "holds frames, which");
  EXPECT_TRUE(fs::exists(folder_ / "moved" / "0.vtu"));
}

TEST_F(OutputFolder, AListCannotNameWhatLiesOutside) {
  const fs::path out = folder_ / "out";
  run(out);
  put(folder_ / "precious.txt", "x");
  std::ofstream(out / "list", std::ios::app) << "../precious.txt\n"
                                             << (folder_ / "precious.txt").string() << '\n';
  run(out, "again");
  EXPECT_EQ(read_file(folder_ / "precious.txt"), "x");
  EXPECT_EQ(read_file(out / "table.csv"), "again");
}

TEST_F(OutputFolder, WhatComesMeanwhileStays) {
  const fs::path target = folder_ / "out";
  run(target, "old");
  {
    OutputDirectory out(target, listed);
    fill(out, "new");
    put(target / "notes" / "a.txt", "mine");
    put(target / "frames" / "b.txt", "mine");
    out.commit();
  }
  EXPECT_EQ(read_file(target / "table.csv"), "new");
  EXPECT_THAT(names(), ElementsAre("out/frames/0.vtu", "out/frames/b.txt", "out/list",
                                   "out/notes/a.txt", "out/table.csv"));
}

TEST_F(OutputFolder, TheCurrentFolderStaysTheSame) {
  const fs::path here = folder_ / "here";
  fs::create_directory(here);
  fs::current_path(here);
  run(".", "1");
  EXPECT_EQ(read_file("table.csv"), "1");
  run(".", "2");
  EXPECT_EQ(read_file("table.csv"), "2");
  EXPECT_THAT(names(), ElementsAre("here/frames/0.vtu", "here/list", "here/table.csv"));
  put(here / "scene.toml", "mine");
  expect_refused(".", "holds scene.toml");
  {
    fs::remove("scene.toml");
    OutputDirectory out(".", listed);
    fill(out, "3");
    put(here / "late.txt", "mine");
  }
  EXPECT_THAT(names(),
              ElementsAre("here/frames/0.vtu", "here/late.txt", "here/list", "here/table.csv"));
}

TEST_F(OutputFolder, ALinkIsFollowed) {
  fs::create_directories(folder_ / "disk");
  fs::create_symlink("disk", folder_ / "out");
  run(folder_ / "out");
  EXPECT_TRUE(fs::is_symlink(folder_ / "out"));
  EXPECT_EQ(read_file(folder_ / "disk" / "table.csv"), "new");
  fs::create_symlink("nowhere", folder_ / "dangling");
  expect_refused(folder_ / "dangling", "is a link to nowhere, which does not exist");
  fs::create_symlink("circle", folder_ / "circle");
  expect_refused(folder_ / "circle", "cannot be written");
}

TEST_F(OutputFolder, AnInputIsNotReplaced) {
  const fs::path out = folder_ / "out";
  run(out, "old");
  EXPECT_THAT(
      [&] {
        OutputDirectory again(out, listed, {"", out / "table.csv"});
      },
      ThrowsMessage<InputError>(HasSubstr("table.csv: lies in ")));
  EXPECT_NO_THROW(OutputDirectory(folder_ / "other", listed, {out / "table.csv"}));
}

TEST_F(OutputFolder, AnEarlierOneSurvivesAFailedCommit) {
  const fs::path target = folder_ / "out";
  run(target, "earlier");
  {
    OutputDirectory out(target, listed);
    fs::remove_all(out.path());  // as if the disk had gone: renaming fails
    EXPECT_THAT([&] { out.commit(); }, ThrowsMessage<InputError>(HasSubstr("cannot be written")));
  }
  EXPECT_EQ(read_file(target / "table.csv"), "earlier");
  EXPECT_THAT(names(), ElementsAre("out/frames/0.vtu", "out/list", "out/table.csv"));
}

TEST_F(OutputFolder, AnExceptionLeavesNothing) {
  try {
    OutputDirectory out(folder_ / "out", listed);
    fill(out, "half");
    throw NumericalError("no positive pivot");
  } catch (const NumericalError&) {
  }
  EXPECT_TRUE(fs::is_empty(folder_));
}

TEST_F(OutputFolder, ANameOfAnyLengthWillDo) {
  const fs::path target = folder_ / std::string(255, 'o');
  run(target, "1");
  run(target, "2");
  EXPECT_EQ(read_file(target / "table.csv"), "2");
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1);
}

TEST_F(OutputFolder, IsNotWhatSomebodyPutInItsPlace) {
  const fs::path elsewhere = folder_ / "elsewhere";
  fs::create_directories(elsewhere);
  {
    OutputDirectory out(folder_ / "out", [](const fs::path&) { return std::set<std::string>(); });
    fs::rename(out.path(), folder_ / "aside");
    fs::create_directory_symlink(elsewhere, out.path());
    EXPECT_THROW(out.commit(), InputError);
  }
  EXPECT_FALSE(fs::exists(folder_ / "out"));
  EXPECT_TRUE(fs::is_empty(elsewhere));
}

}  // namespace
}  // namespace hyperex
