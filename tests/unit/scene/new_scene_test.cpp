// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/new_scene.hpp"

#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "hyperex/scene/toml_values.hpp"
#include "support/test_file.hpp"

namespace hyperex::scene {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(RecordingKey, IsToldByTheEndingAndTheColumns) {
  const TestFolder folder;
  const auto key = [&](const char* name, const char* head) {
    std::ofstream(folder / name) << head;
    return recording_key(folder / name);
  };
  EXPECT_EQ(key("a.csv", "time_s,mouthSmileLeft\n"), "motion.arkit");
  EXPECT_EQ(key("semicolons.csv", "Timecode;BlendShapeCount;EyeBlinkLeft\n"), "motion.arkit");
  EXPECT_EQ(key("tabs.csv", "time_s\t\"jawOpen\"\n"), "motion.arkit");
  EXPECT_EQ(key("comment.csv", "# A smile.\n\ntime_s,mouthSmileRight\n"), "motion.arkit");
  EXPECT_EQ(key("b.csv", "frame, AU12_r\n"), "motion.openface");
  EXPECT_EQ(key("c.csv", "time_s,name,x_mm\n"), "motion.file");
  EXPECT_EQ(key("d.TRC", ""), "motion.file");
  EXPECT_EQ(key("e.mp4", ""), "motion.recording");
  EXPECT_EQ(recording_key(folder), "motion.recording");
}

TEST(NewScene, SaysWhatItIsOfWhateverTheNames) {
  const std::string odd = "my \"face\"\n# [scan] 'x'";
  const NewScene of{odd + ".ply", odd + ".csv", "motion.arkit", "cm", "guessed\nby its size",
                    {},           odd};
  const std::string text = new_scene_text(of);
  const nlohmann::json root = parse_toml(text).root;
  EXPECT_EQ(root.at("title"), odd);
  EXPECT_EQ(root.at("scan"), nlohmann::json({{"file", odd + ".ply"}, {"unit", "cm"}}));
  EXPECT_EQ(root.at("motion"), nlohmann::json({{"arkit", odd + ".csv"}}));
  EXPECT_EQ(root.at("variant").size(), 1u);
  EXPECT_THAT(text, HasSubstr("# guessed?by its size\n"));
}

TEST(NewScene, NamesThePointsOfTheSkull) {
  const std::string text =
      new_scene_text({"a.ply", "a.csv", "motion.file", "mm", "stated", {"head_1", "a \"b\""}, "a"});
  EXPECT_EQ(parse_toml(text).root.at("motion").at("rigid_points"),
            nlohmann::json({"head_1", "a \"b\""}));
}

TEST(NewScene, OfALongRecordingWritesFewerFrames) {
  const NewScene brief{"a.ply", "a.csv", "motion.arkit", "mm", "stated", {}, "a"};
  EXPECT_FALSE(parse_toml(new_scene_text(brief)).root.contains("output"));
  NewScene lengthy = brief;
  lengthy.vtu_every = 3;
  const std::string text = new_scene_text(lengthy);
  EXPECT_EQ(parse_toml(text).root.at("output"), nlohmann::json({{"vtu_every", 3}}));
  EXPECT_THAT(text, HasSubstr("# The recording is long: all frames for ParaView"));
}

TEST(NewScene, APartOfARecordingEndsBeforeItDoes) {
  NewScene of{"a.ply", "a.csv", "motion.arkit", "mm", "stated", {}, "a"};
  for (const double recording_s : {12.0, 13.0, 134.0, 3600.0}) {
    const auto part = part_to_run(recording_s);
    ASSERT_TRUE(part) << recording_s;
    EXPECT_LE(part->start_s + part->end_s, recording_s + 0.5);
    of.long_s = recording_s;
    EXPECT_THAT(new_scene_text(of), HasSubstr("To run a part of it"));
  }
  // Noise and many points make a run long, too.
  EXPECT_FALSE(part_to_run(9.4));
  of.long_s = 9.4;
  EXPECT_THAT(new_scene_text(of), testing::Not(HasSubstr("To run a part of it")));
}

TEST(NewScene, WhatIsCommentedOutIsSoundToo) {
  NewScene of{"a.ply", "film.mp4", "motion.recording", "mm", "stated", {}, "a"};
  of.long_s = 134;
  const std::string text = new_scene_text(of);
  EXPECT_THAT(text, HasSubstr("#   hyperex run a.toml --out out/a\n"));
  // Lines of comments that are keys or tables, uncommented.
  std::string used;
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    std::string line = text.substr(begin, end - begin);
    if (line.starts_with("# ") && (line.find(" = ") != std::string::npos || line[2] == '['))
      line = line.substr(2);
    used += line + '\n';
  }
  const nlohmann::json root = parse_toml(used).root;
  EXPECT_EQ(root.at("variant").size(), 3u);
  EXPECT_EQ(root.at("scan").at("landmarks"), "landmarks.json");
  EXPECT_EQ(root.at("motion").at("mirrored"), true);
  EXPECT_EQ(root.at("tissue").at("preset"), "aged_skin");
  EXPECT_EQ(root.at("time"), nlohmann::json({{"start_s", 67}, {"end_s", 6}}));
}

}  // namespace
}  // namespace hyperex::scene
