// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"
#include "support/test_file.hpp"

namespace hyperex::scene {

/// A new folder for a test, with the files that scenes need; removed at the end.
class SceneFolder : public TestFolder {
 public:
  SceneFolder() {
    for (const char* file : {"face.ply", "points.json", "motion.csv"}) write(file, "");
    std::filesystem::create_directory(*this / "sub");
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(*this / name, std::ios::binary) << text;
    return *this / name;
  }
};

inline std::string sentences(const std::vector<InputProblem>& problems) {
  std::string text;
  for (const auto& problem : problems) text += problem.sentence() + "\n";
  return text;
}

inline const char* const smallest = "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n";

}  // namespace hyperex::scene
