// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/setting_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hyperex::run {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(SettingWords, SayNothingOfDefaultsButTheLips) {
  scene::Scene scene;
  scene.contact.lips = false;
  EXPECT_THAT(setting_lines(scene), IsEmpty());
  scene.contact.lips = true;
  EXPECT_THAT(setting_lines(scene), ElementsAre(HasSubstr("contact.lips = false turns it off")));
  scene.origins["contact.lips"] = {};
  EXPECT_THAT(setting_lines(scene), IsEmpty()) << "the scene asks for it";
}

TEST(SettingWords, NameGainsWithTheirSides) {
  scene::Scene scene;
  scene.contact.lips = false;
  scene.muscles.gains = {{"side_L", 0.6}, {"zyg_minor_L", 1}, {"zygomatic_R", 1.2}};
  EXPECT_THAT(
      setting_lines(scene),
      ElementsAre("muscles.gain multiplies activations: left side by 0.6, zygomatic (right) by "
                  "1.2"));
  scene.muscles.gains = {{"zyg_minor_L", 1}};
  EXPECT_THAT(setting_lines(scene), IsEmpty()) << "1 changes nothing";
  scene.muscles.gains.assign(9, {"zygomatic_R", 0.5});
  EXPECT_THAT(setting_lines(scene), ElementsAre(HasSubstr(" by 0.5, and 3 more")));
}

TEST(SettingWords, NamePresetAndLayers) {
  scene::Scene scene;
  scene.contact.lips = false;
  scene.tissue.preset = "skin_fat_deep";
  scene.mesh.layers = 4;
  EXPECT_THAT(setting_lines(scene),
              ElementsAre("tissue: preset skin_fat_deep, 3 layers of tissue, 4 layers of "
                          "elements"));
}

TEST(ContactLine, SaysWhatContactDidWhereItActed) {
  EXPECT_EQ(contact_line(nlohmann::ordered_json::object()), "") << "it is off";
  nlohmann::ordered_json summary{
      {"contact", {{"frames", 0}, {"lip_overlap_without_mm", 0.001}, {"lip_overlap_mm", 0.001}}}};
  EXPECT_EQ(contact_line(summary), "") << "nothing touches";
  summary["contact"] = {
      {"frames", 12}, {"lip_overlap_without_mm", 0.341}, {"lip_overlap_mm", 0.012}};
  EXPECT_EQ(contact_line(summary),
            "contact acted in 12 frames: the lips would overlap by up to 0.34 mm (now 0.01 mm)\n");
  summary["contact"] = {{"frames", 1},           {"lip_overlap_without_mm", 0.001},
                        {"lip_overlap_mm", 0.0}, {"in_teeth_without_mm", 1.2},
                        {"in_teeth_mm", 0.0},    {"in_eyes_without_mm", 0.5},
                        {"in_eyes_mm", 0.0}};
  EXPECT_EQ(contact_line(summary),
            "contact acted in 1 frame: tissue would be in the teeth by up to 1.20 mm (now 0.00 "
            "mm), the lids would be in the eyes by up to 0.50 mm (now 0.00 mm)\n");
}

}  // namespace
}  // namespace hyperex::run
