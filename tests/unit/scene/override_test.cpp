// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/override.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

#include "hyperex/scene/file_names.hpp"
#include "hyperex/scene/toml_values.hpp"
#include "support/refusal.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {
using nlohmann::json;

TEST(Override, IsToldWithItsPlaceAndTakesPathsFromItsFolder) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", smallest);
  folder.write("sub/own.csv", "");
  const Scene scene =
      read_scene_with(file, {{"motion.file=\"own.csv\"", {"study.toml", 7}, folder / "sub"},
                             {"tissue.young_kpa=30", {"study.toml", 8}, folder / "sub"}});
  EXPECT_EQ(scene.motion.source.file, folder / "sub/own.csv");
  EXPECT_EQ(scene.origins.at("tissue.young_kpa").file, "study.toml");
  EXPECT_EQ(problem_at(scene, "tissue.young_kpa", "less").sentence(),
            "study.toml:8: tissue.young_kpa = 30.0: expected less");
  EXPECT_THAT(test::refusal([&] {
                read_scene_with(file, {{"tissue.young_kpa=-3", {"study.toml", 8}, {}}});
              }),
              testing::StartsWith("study.toml:8: tissue.young_kpa = -3: expected"));
}

TEST(Override, AStudyInThePlaceOfASceneIsRecognised) {
  const SceneFolder folder;
  const auto file = folder.write("study.toml", "scene = \"scene.toml\"\n[grid]\n");
  EXPECT_THAT(sentences(problems_of(file)),
              testing::HasSubstr("expected a scene file; this is a study: hyperex sweep "));
}

/// Another source of motion replaces that of the scene, as with --set.
TEST(Override, OfTheMotionReplacesItsSource) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", smallest);
  const Scene scene =
      read_scene_with(file, {{"motion.recording=\"sub\"", {"study.toml", 1}, folder / ""}});
  EXPECT_EQ(scene.motion.recording, folder / "sub");
  EXPECT_FALSE(scene.motion.source.embedded);
}

TEST(TomlText, ComesBackAsItWas) {
  const json values[] = {1,
                         -2.5,
                         1e-5,
                         1e300,
                         true,
                         "it's \"quoted\" \\ \n \x7f \u00e4",
                         {"a", "b"},
                         {{1.5, 2}, {3, 4}},
                         {{{"name", "cheek_R"}, {"young_factor", 10}, {"odd key", {1}}}},
                         json::array()};
  for (const json& value : values) {
    const auto back = parse_toml_value(toml_text(value));
    ASSERT_TRUE(back) << toml_text(value);
    EXPECT_EQ(*back, value) << toml_text(value);
    EXPECT_EQ(toml_text(value).find('\n'), std::string::npos);
  }
  EXPECT_EQ(toml_text(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(toml_text(std::nan("")), "nan");
}

TEST(OptionsWithPaths, ReplaceEachPathAndNothingElse) {
  const SceneFolder folder;
  folder.write("paint.ply", "");
  const auto file = folder.write(
      "scene.toml",
      "scan = { file = \"face.ply\" }\nmotion = { file = \"embedded\" }\ntitle = \"face.ply\"\n"
      "tissue = { region = [{ painted = \"paint.ply\", young_factor = 2 }] }\n");
  std::vector<std::string> seen;
  const json options = options_with_paths(read_scene(file), [&](const std::string& path) {
    seen.push_back(path);
    return std::string("#");
  });
  EXPECT_EQ(options["scan"]["file"], "#");
  EXPECT_EQ(options["tissue"]["region"][0]["painted"], "#");
  EXPECT_EQ(options["title"], "face.ply");
  EXPECT_THAT(seen, testing::UnorderedElementsAre((folder / "face.ply").string(), "embedded",
                                                  (folder / "paint.ply").string()));
}

}  // namespace
}  // namespace hyperex::scene
