// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/earlier_run.hpp"

#include <gmock/gmock.h>

#include "unit/scene/scene_files.hpp"

namespace hyperex::run {
using namespace scene;
namespace {
namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(EarlierRun, IsKnownByItsSummaryAlone) {
  const SceneFolder folder;
  EXPECT_THAT(files_of_earlier_run(folder / ""), IsEmpty());
  for (const char* summary :
       {"{}", "[]", "", "{\"program\": \"hype", "{\"program\": \"other\", \"files\": [\"a\"]}",
        "{\"program\": 3}", "{\"files\": [\"a\"]}"}) {
    folder.write("summary.json", summary);
    EXPECT_THAT(files_of_earlier_run(folder / ""), IsEmpty()) << summary;
    EXPECT_FALSE(is_folder_of_run(folder / "")) << summary;
  }
  folder.write("summary.json", "{\"program\": \"hyperex\", \"files\": [\"b\", \"a/c\", 3]}");
  EXPECT_THAT(files_of_earlier_run(folder / ""), ElementsAre("a/c", "b"));
  folder.write("summary.json", "{\"program\": \"hyperex\", \"files\": \"all\"}");
  EXPECT_THAT(files_of_earlier_run(folder / ""), ElementsAre("all"));
  EXPECT_TRUE(is_folder_of_run(folder / ""));
}

TEST(EarlierRun, AnotherCommandsOutputsAreNotARuns) {
  const SceneFolder folder;
  folder.write("summary.json",
               R"({"program": "hyperex", "command": "ct", "files": ["skin.ply", "summary.json"]})");
  EXPECT_THAT(files_of_earlier_run(folder / ""), IsEmpty());
  EXPECT_FALSE(is_folder_of_run(folder / ""));
}

TEST(EarlierRun, WithoutAListTheNamesOfOutputsAreTaken) {
  const SceneFolder folder;  // with a face.ply, motion.csv, points.json
  folder.write("summary.json", "{\"program\": \"hyperex\"}");
  fs::create_directories(folder / "frames");
  fs::create_directories(folder / "variants/stiff/frames");
  for (const char* name :
       {"frames/frame_0001.vtu", "frames/notes.txt", "variants/stiff/skin_peak.ply",
        "variants/stiff/letter.txt", "variants/skin_peak.ply", "sub/report.html", "report.html",
        "variants/stiff/frames/frame_0000.vtu"})
    folder.write(name, "");
  EXPECT_THAT(files_of_earlier_run(folder / ""),
              ElementsAre("frames/frame_0001.vtu", "motion.csv", "report.html", "summary.json",
                          "variants/stiff/skin_peak.ply"));
}

TEST(EarlierRun, EveryFileOfASceneIsNamed) {
  const SceneFolder folder;
  folder.write("depth.csv", "");
  folder.write("paint.csv", "");
  const fs::path file =
      folder.write("scene.toml",
                   "scan = { file = \"face.ply\", landmarks = \"points.json\" }\n"
                   "motion = { file = \"motion.csv\" }\ntissue = { per_vertex = \"motion.csv\" }\n"
                   "mesh = { thickness_per_vertex = \"depth.csv\", thickness_region = "
                   "[{ painted = \"paint.csv\", thickness_mm = 9 }] }\n"
                   "[[variant]]\nname = \"a\"\n"
                   "tissue = { region = [{ painted = \"sub/../face.ply\", young_factor = 2 }] }\n");
  std::set<fs::path> named;
  for (const fs::path& path : files_named_by(read_scene(file))) named.insert(path);
  EXPECT_THAT(named, ElementsAre(folder / "depth.csv", folder / "face.ply", folder / "motion.csv",
                                 folder / "paint.csv", folder / "points.json", file));
}

}  // namespace
}  // namespace hyperex::run
