// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "hyperex/scene/scene.hpp"

namespace hyperex::scene {

/// A folder of its own for a test, with what scenes need in it; removed afterwards.
class SceneFolder {
 public:
  SceneFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "hyperex_scene_XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = name;
    for (const char* file : {"face.ply", "points.json", "motion.csv"}) write(file, "");
    std::filesystem::create_directory(folder_ / "sub");
  }
  ~SceneFolder() { std::filesystem::remove_all(folder_); }
  SceneFolder(const SceneFolder&) = delete;
  SceneFolder& operator=(const SceneFolder&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }
  std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

inline std::string sentences(const std::vector<InputProblem>& problems) {
  std::string text;
  for (const auto& problem : problems) text += problem.sentence() + "\n";
  return text;
}

inline const char* const smallest = "[scan]\nfile = \"embedded\"\n[motion]\nfile = \"embedded\"\n";

}  // namespace hyperex::scene
