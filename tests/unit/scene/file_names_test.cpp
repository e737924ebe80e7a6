// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/file_names.hpp"

#include <gtest/gtest.h>

#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {

Scene scene_of(const SceneFolder& folder, const std::string& more = "") {
  folder.write("sub/painted.csv", "");
  return read_scene(folder.write(
      "scene.toml",
      "scan = { file = \"face.ply\", landmarks = \"points.json\" }\n"
      "motion.recording = \"sub/\"\n"
      "tissue.region = [{ painted = \"sub/painted.csv\", young_factor = 2 }]\n" +
          more +
          "[[variant]]\nname = \"a\"\ntissue = { region = [{ painted = \"sub/painted.csv\", "
          "young_factor = 3 }], per_vertex = \"sub/painted.csv\" }\n"));
}

TEST(FileNames, StandWithoutFoldersInWhatIsWritten) {
  const SceneFolder folder;
  const Scene scene = scene_of(folder);
  const auto options = echoed_options(scene);
  EXPECT_EQ(options["scan"]["file"], "face.ply");
  EXPECT_EQ(options["scan"]["landmarks"], "points.json");
  EXPECT_EQ(options["motion"]["recording"], "sub");
  EXPECT_EQ(options["tissue"]["region"][0]["painted"], "painted.csv");
  EXPECT_EQ(options["motion"]["file"], "");
  const auto changes = echoed_changes(scene, scene.variants.at(0).changes);
  EXPECT_EQ(changes["tissue.region"][0]["painted"], "painted.csv");
  EXPECT_EQ(changes["tissue.per_vertex"], "painted.csv");
  const std::string place = (folder / "").string();
  EXPECT_EQ(options.dump().find(place), std::string::npos);
  EXPECT_EQ(with_file_names(scene, "motion: " + place + "sub/: no depth.txt; " + place +
                                       "sub/camera.toml:2: x; " + place + "face.ply: torn"),
            "motion: sub/: no depth.txt; sub/camera.toml:2: x; face.ply: torn");
}

TEST(FileNames, AreWholeWhereTheSceneAsksForIt) {
  const SceneFolder folder;
  const Scene scene = scene_of(folder, "output.full_paths = true\n");
  EXPECT_EQ(echoed_options(scene)["scan"]["file"], (folder / "face.ply").string());
  EXPECT_EQ(echoed_changes(scene, {{"tissue.per_vertex", "sub/painted.csv"}})["tissue.per_vertex"],
            "sub/painted.csv");
  const std::string note = (folder / "face.ply").string() + ": torn";
  EXPECT_EQ(with_file_names(scene, note), note);
}

}  // namespace
}  // namespace hyperex::scene
