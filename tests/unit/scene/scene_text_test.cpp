// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/scene_text.hpp"

#include <gmock/gmock.h>

#include "hyperex/scene/toml_values.hpp"

namespace hyperex::scene {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

const std::string kScene = R"(# A scene
title = "Äußerst"  # with a word

scan = { file = "me.ply", unit = "mm" }
motion.file = "smile.csv"

[tissue]
# Softer than usual.
young_kpa = 150  # of the cheek
regions = [
  { name = "cheek_R", young_factor = 2 },
]

# What if?
[[variant]]
name = "stiff"
tissue.young_kpa = 400

# The other one.
[[variant]]
name = "weak"
[variant.muscles]
gain = { zyg_major_R = 0.3 }

[output]
vtu = false
)";

TEST(SceneText, ReplacesAValueAndKeepsTheRest) {
  const std::string text = with_value(kScene, "tissue.young_kpa", 90.5);
  EXPECT_EQ(text.size(), kScene.size() + 1);
  EXPECT_THAT(text, HasSubstr("young_kpa = 90.5  # of the cheek"));
  EXPECT_THAT(with_value(kScene, "title", "x"), HasSubstr("title = \"x\"  # with a word"));
  EXPECT_THAT(with_value(kScene, "scan.unit", "m"),
              HasSubstr("scan = { file = \"me.ply\", unit = \"m\" }"));
  EXPECT_THAT(with_value(kScene, "motion.file", "b.csv"), HasSubstr("motion.file = \"b.csv\"\n"));
  EXPECT_THAT(with_value(kScene, "tissue.regions", json::array()),
              HasSubstr("regions = []\n\n# What if?"));
}

TEST(SceneText, AddsAKeyWhereItsSectionStandsOrBeforeTheVariants) {
  EXPECT_THAT(with_value(kScene, "tissue.poisson", 0.4), HasSubstr("]\npoisson = 0.4\n\n# What"));
  EXPECT_THAT(with_value(kScene, "output.glb", false), HasSubstr("vtu = false\nglb = false\n"));
  EXPECT_THAT(with_value(kScene, "time.step_s", 0.01),
              HasSubstr("\n[time]\nstep_s = 0.01\n\n# What if?"));
  EXPECT_EQ(with_value("", "time.step_s", 0.01), "[time]\nstep_s = 0.01\n");
  EXPECT_EQ(with_value("title = \"a\"", "time.step_s", 0.01),
            "title = \"a\"\n\n[time]\nstep_s = 0.01\n");
  EXPECT_EQ(with_value("[time]\nstep_s = 1\n", "title", "a"),
            "title = \"a\"\n[time]\nstep_s = 1\n");
}

TEST(SceneText, TakesAKeyAway) {
  const std::string text = with_value(kScene, "tissue.young_kpa", nullptr);
  EXPECT_THAT(text, Not(HasSubstr("150")));
  EXPECT_THAT(text, HasSubstr("# Softer than usual.\nregions"));
  EXPECT_EQ(with_value(kScene, "time.step_s", nullptr), kScene);
}

TEST(SceneText, EveryEditIsWhatWasWanted) {
  const std::vector<std::pair<std::string, json>> edits = {
      {"scan.landmarks", "l.json"},
      {"motion.mirrored", true},
      {"motion.file", nullptr},
      {"scan.unit", nullptr},
      {"tissue.regions", nullptr},
      {"output.vtu", nullptr},
      {"muscles.gain", {{"zyg_major_R", 0.3}, {"side_L", 0}}},
      {"title", "a \"b\"\n\tc"}};
  std::string text = kScene;
  json wanted = parse_toml(kScene).root;
  for (const auto& [key, value] : edits) {
    text = with_value(text, key, value);
    const auto dot = key.find('.');
    if (dot == std::string::npos)
      wanted[key] = value;
    else if (value.is_null())
      wanted[key.substr(0, dot)].erase(key.substr(dot + 1));
    else
      wanted[key.substr(0, dot)][key.substr(dot + 1)] = value;
    for (auto it = wanted.begin(); it != wanted.end();)
      it = it->is_object() && it->empty() ? wanted.erase(it) : std::next(it);
    json got = parse_toml(text).root;
    for (auto it = got.begin(); it != got.end();)
      it = it->is_object() && it->empty() ? got.erase(it) : std::next(it);
    EXPECT_EQ(got, wanted) << key << "\n" << text;
  }
}

TEST(SceneText, VariantsHaveTextsWhereTheyAreWrittenOneByOne) {
  EXPECT_THAT(variant_texts(kScene),
              testing::ElementsAre("[[variant]]\nname = \"stiff\"\ntissue.young_kpa = 400\n",
                                   "[[variant]]\nname = \"weak\"\n[variant.muscles]\n"
                                   "gain = { zyg_major_R = 0.3 }\n"));
  EXPECT_THAT(variant_texts("variant = [{ name = \"a\", tissue = { young_kpa = 4 } }]\n"),
              testing::IsEmpty());
  EXPECT_THAT(variant_texts("title = '''\n[[variant]]\n'''\n"), testing::IsEmpty());
}

TEST(SceneText, VariantsThatStayKeepTheirText) {
  std::vector<json> blocks = variant_blocks(kScene);
  ASSERT_EQ(blocks.size(), 2U);
  blocks[0]["tissue"]["young_kpa"] = 500;
  blocks.push_back({{"name", "new"}, {"preset", "aged"}, {"muscles", {{"gain", {{"side_R", 0}}}}}});
  const std::string text = with_variants(kScene, blocks);
  EXPECT_EQ(variant_blocks(text), blocks);
  EXPECT_THAT(text, HasSubstr("[variant.muscles]\ngain = { zyg_major_R = 0.3 }"));
  EXPECT_THAT(text, HasSubstr("young_kpa = 150  # of the cheek"));
  EXPECT_THAT(text, HasSubstr("[output]\nvtu = false"));
  EXPECT_THAT(with_variants(kScene, {}), Not(HasSubstr("variant]")));
  const std::string inline_list = "variant = [{ name = \"a\", tissue = { young_kpa = 4 } }]\n";
  blocks = variant_blocks(inline_list);
  blocks.push_back({{"name", "b"}, {"tissue", {{"young_kpa", 7}}}});
  EXPECT_EQ(variant_blocks(with_variants(inline_list, blocks)), blocks);
}

}  // namespace
}  // namespace hyperex::scene
