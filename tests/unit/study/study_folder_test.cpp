// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/study_folder.hpp"

#include <gmock/gmock.h>

#include "unit/study/study_files.hpp"

namespace hyperex::study {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class StudyFolder : public StudyFiles {};

TEST_F(StudyFolder, MayBeNewEmptyOrOfAnEarlierSweep) {
  make_study_folder(*this / "deep/new");
  EXPECT_TRUE(fs::is_directory(*this / "deep/new/cases"));
  fs::create_directory(*this / "empty");
  EXPECT_NO_THROW(make_study_folder(*this / "empty"));
  EXPECT_NO_THROW(make_study_folder(*this / "empty"));
  // With a table the user's notes beside it do no harm.
  write("empty/study.csv", "case,state,folder\n");
  write("empty/notes.txt", "mine");
  EXPECT_NO_THROW(make_study_folder(*this / "empty"));
  EXPECT_EQ(read(*this / "empty/notes.txt"), "mine");
}

TEST_F(StudyFolder, IsRefusedWhereItIsTheUsers) {
  write("mine/photo.jpg", "x");
  EXPECT_EQ(refusal([&] { check_study_folder(*this / "mine"); }),
            "mine: holds photo.jpg, which no sweep wrote; expected a new or empty folder, or one "
            "of an earlier sweep");
  EXPECT_FALSE(fs::exists(*this / "mine/cases"));
  write("table/study.csv", "patient,age\n");
  EXPECT_THAT(refusal([&] { check_study_folder(*this / "table"); }), HasSubstr("study.csv"));
  EXPECT_EQ(refusal([&] { check_study_folder(*this / "scene.toml"); }),
            "scene.toml: is a file; expected the name of a folder for the study");
}

}  // namespace
}  // namespace hyperex::study
