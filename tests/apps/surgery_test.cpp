// SPDX-License-Identifier: GPL-3.0-or-later
// Bones that a variant moves, end to end.
#include <gmock/gmock.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/program.hpp"
#include "hyperex/core/files.hpp"

namespace hyperex {
namespace {

class Surgery : public ProgramTest {
 protected:
  void write(const std::string& variant, const std::string& more = "") {
    std::ofstream(in("scene.toml"))
        << "scan = { file = \"embedded\" }\nmotion = { arkit = \"" HYPEREX_SOURCE_DIR
           "/examples/smile_arkit.csv\", time_scale = 0.25 }\n"
           "mesh = { element_size_mm = 7 }\n"
           "output = { vtu = false, glb = false, report = false, picture_times_s = [0] }\n"
        << more << "[[variant]]\nname = \"advancement\"\n"
        << variant << '\n';
  }
  /// What the variant of an output folder's summary does to the face at rest.
  nlohmann::json surgery_in(const std::string& folder) const {
    return nlohmann::json::parse(
        read_file(in(folder + "/summary.json")))["variants"]["table"][1]["surgery"];
  }
};

TEST_F(Surgery, WritesMillimetresAndPicturesOfTheFaceAfterwards) {
  write("bone = [{ part = \"mandible\", move_mm = [0, 0, 6] }]");
  const Outcome outcome = call("run scene.toml --out out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex(
                               "advancement, at rest: chin [0-9.]+ mm \\([0-9.]+ of the bone; "
                               "published 0.80 to 1.33\\), lower lip"));
  EXPECT_TRUE(std::filesystem::exists(in("out/variants/advancement/surgery.png")));
  EXPECT_FALSE(std::filesystem::exists(in("out/surgery.csv")));
  EXPECT_THAT(read_file(in("out/variants/advancement/surgery.csv")),
              testing::StartsWith("landmark,rest_left_mm,rest_up_mm,rest_forward_mm,"));
  const auto summary = nlohmann::json::parse(read_file(in("out/summary.json")));
  const auto& row = summary["variants"]["table"][1];
  EXPECT_EQ(row["inverted_tets"], 0);
  EXPECT_LT(row["lip_overlap_mm"], 0.1) << "lips are kept apart";
  double chin = 0, lip = 0;
  for (const auto& one : row["surgery"]["landmarks"]) {
    if (one["landmark"] == "pogonion") chin = one["soft_per_bone"];
    if (one["landmark"] == "labiale_inferius") lip = one["soft_per_bone"];
  }
  EXPECT_GT(chin, 0.8);
  EXPECT_LT(chin, 1.1);
  EXPECT_GT(lip, 0.5);
  EXPECT_LT(lip, 0.9);
  // The excursion counts from the face at rest after surgery.
  EXPECT_LT(row["commissure_L_from_base_mm"], 3);
  // Again with the same options: an earlier run's folder is replaced.
  EXPECT_EQ(call("run scene.toml --out out").status, 0);
}

TEST_F(Surgery, OfBaseIsNotThatOfItsVariants) {
  write(
      "muscles.gain = { side_R = 0.5 }\n[[variant]]\nname = \"farther\"\n"
      "bone = [{ part = \"mandible\", move_mm = [0, 0, 6] }]",
      "surgery = { bone = [{ part = \"mandible\", move_mm = [0, 0, 4] }] }\n"
      "drive = { by = \"muscles\" }\n");
  const Outcome outcome = call("run scene.toml --out out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto table = nlohmann::json::parse(read_file(in("out/summary.json")))["variants"]["table"];
  EXPECT_FALSE(table[1].contains("surgery")) << "its bones lie as those of base";
  ASSERT_TRUE(table[2].contains("surgery"));
  for (const auto& one : table[2]["surgery"]["landmarks"]) {
    EXPECT_FALSE(one.contains("soft_per_bone")) << "2 mm more are no advancement of 6 mm";
    if (one["landmark"] != "pogonion") continue;
    EXPECT_NEAR(one["at_rest_mm"][2], 2, 0.5);
  }
}

TEST_F(Surgery, AddsVolumeUnderAPlaceOfTheSkin) {
  write("tissue.region = [{ name = \"cheek_L\", volume_ml = 2 }]");
  const Outcome outcome = call("run scene.toml --out out");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, testing::ContainsRegex(
                               "advancement, at rest: 2 ml added, of which [0-9.]+ ml show at "
                               "the skin; it moves by up to [0-9.]+ mm"));
  EXPECT_TRUE(std::filesystem::exists(in("out/variants/advancement/surgery.png")));
  const auto surgery = surgery_in("out");
  EXPECT_EQ(surgery["added_volume_ml"], 2);
  EXPECT_GT(surgery["skin_volume_change_ml"], 1.4);
  EXPECT_LT(surgery["skin_volume_change_ml"], 2.3);
  EXPECT_GT(surgery["greatest_at_rest_mm"], 0.3);
  EXPECT_LT(surgery["greatest_at_rest_mm"], 3);
  for (const auto& one : surgery["landmarks"]) EXPECT_FALSE(one.contains("published"));

  write("tissue.region = [{ name = \"cheek_L\", volume_ml = 25 }]");
  const Outcome refused = call("run scene.toml --out none");
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, testing::AllOf(testing::HasSubstr("region[0].volume_ml"),
                                          testing::HasSubstr("times its volume")));
  EXPECT_FALSE(std::filesystem::exists(in("none")));
}

TEST_F(Surgery, TellsBonesAndVolumeApart) {
  write(
      "tissue.region = [{ name = \"cheek_L\", volume_ml = 2 }]\n"
      "bone = [{ part = \"mandible\", move_mm = [0, 0, 6] }]");
  const Outcome both = call("run scene.toml --out out");
  ASSERT_EQ(both.status, 0) << both.err;
  EXPECT_THAT(both.out, testing::ContainsRegex("at rest: chin [0-9.]+ mm, .*, 2 ml added\n"));
  for (const auto& one : surgery_in("out")["landmarks"])
    EXPECT_FALSE(one.contains("published")) << "not of bones alone";

  // The same volume elsewhere, and another stiffness there.
  write("tissue.region = [{ name = \"cheek_R\", volume_ml = 2, young_factor = 2 }]",
        "tissue.region = [{ name = \"cheek_L\", volume_ml = 2 }]\n"
        "drive = { by = \"muscles\" }\n");
  const Outcome elsewhere = call("run scene.toml --out elsewhere");
  ASSERT_EQ(elsewhere.status, 0) << elsewhere.err;
  EXPECT_THAT(elsewhere.out, testing::HasSubstr("at rest: volume is elsewhere; the skin moves"));
  EXPECT_NEAR(surgery_in("elsewhere")["added_volume_ml"].get<double>(), 0, 1e-9);
}

TEST_F(Surgery, IsRefusedInOneSentence) {
  const auto refused = [&](const std::string& variant, const std::string& more = "") {
    write(variant, more);
    const Outcome outcome = call("run scene.toml --out none");
    EXPECT_EQ(outcome.status, 2);
    EXPECT_FALSE(std::filesystem::exists(in("none")));
    return outcome.err;
  };
  EXPECT_THAT(
      refused("bone = [{ part = \"jaw\", move_mm = [0, 0, 6] }]"),
      testing::AllOf(testing::HasSubstr("surgery.bone[0].part"),
                     testing::HasSubstr("\"skull\", \"maxilla\", \"mandible\" or \"chin\"")));
  EXPECT_THAT(refused("bone = [{ part = \"mandible\", move_mm = [6] }]"),
              testing::HasSubstr("a list of 3 numbers, each from -30 to 30 (mm)"));
  EXPECT_THAT(refused("bone = [{ part = \"mandible\", move_mm = [0, 0, 60] }]"),
              testing::HasSubstr("from -30 to 30"));
  EXPECT_THAT(refused("bone = [{ part = \"mandible\", cut = \"le_fort_1\", move_mm = [0, 0, 6] }]"),
              testing::HasSubstr("standard or bsso, or whole, for the mandible"));
}

TEST_F(Surgery, NeedsForcesThatDriveTheFace) {
  for (const auto& [variant, key] :
       {std::pair{"bone = [{ part = \"mandible\", move_mm = [0, 0, 6] }]", "surgery.bone"},
        {"tissue.region = [{ name = \"cheek_L\", volume_ml = 2 }]", "tissue.region"}}) {
    write(variant, "drive = { by = \"displacement\" }\n");
    const Outcome checked = call("check scene.toml");
    EXPECT_EQ(checked.status, 2);
    EXPECT_THAT(checked.err,
                testing::AllOf(testing::ContainsRegex("scene.toml:[0-9]+"), testing::HasSubstr(key),
                               testing::HasSubstr("drive.by = \"muscles\" or \"reactions\"")));
    EXPECT_EQ(call("run scene.toml --out none").status, 2);
    EXPECT_FALSE(std::filesystem::exists(in("none")));
  }
}

}  // namespace
}  // namespace hyperex
