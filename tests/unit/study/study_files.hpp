// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// A study in its own folder, and a program that takes the place of hyperex.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "hyperex/study/study.hpp"
#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::study {

class StudyFiles : public testing::Test {
 protected:
  void SetUp() override {
    write("scene.toml", "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n");
  }

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::filesystem::create_directories((folder_ / name).parent_path());
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::string read(const std::filesystem::path& file) const {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }
  Study study(const std::string& text) const {
    return read_study(write("study.toml", "scene = \"scene.toml\"\n" + text));
  }
  /// The message of the error that reading it throws, without the folder.
  template <class Act>
  std::string refusal(Act act) const {
    std::string said = test::refusal(act);
    const std::string prefix = (folder_ / "").string();
    for (auto at = said.find(prefix); at != std::string::npos; at = said.find(prefix))
      said.erase(at, prefix.size());
    return said;
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  const TestFolder folder_;
};

}  // namespace hyperex::study
