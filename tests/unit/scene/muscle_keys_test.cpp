// SPDX-License-Identifier: GPL-3.0-or-later
// The keys of muscles: drive.by, [muscles], and the options that exclude each other.
#include <gmock/gmock.h>

#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/scene/file_names.hpp"
#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/variant_presets.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {
using simulate::DriveBy;
using simulate::MuscleGain;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const std::string by_muscles = std::string(smallest) + "[drive]\nby = \"muscles\"\n";

/// The one problem of a scene text, without its folder.
std::string only_muscle_problem(const std::string& text,
                                const std::vector<std::string>& overrides = {}) {
  const SceneFolder folder;
  const auto problems = problems_of(folder.write("scene.toml", text), overrides);
  EXPECT_EQ(problems.size(), 1u) << sentences(problems);
  const std::string sentence = problems.empty() ? "" : problems[0].sentence();
  const std::string prefix = (folder / "").string();
  return sentence.starts_with(prefix) ? sentence.substr(prefix.size()) : sentence;
}

Scene scene_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const SceneFolder folder;
  return read_scene(folder.write("scene.toml", text), overrides);
}

TEST(MuscleKeys, SayWhatDrives) {
  EXPECT_EQ(scene_of(smallest).drive.by, DriveBy::displacement);
  EXPECT_EQ(scene_of(by_muscles).drive.by, DriveBy::muscles);
  EXPECT_EQ(scene_of(smallest, {"drive.by=reactions"}).drive.by, DriveBy::reactions);
  EXPECT_THAT(only_muscle_problem(smallest, {"drive.by=muscle"}),
              HasSubstr("--set: drive.by = \"muscle\": expected \"displacement\", \"muscles\""));
}

TEST(MuscleKeys, MusclesDriveASceneWithVariantsThatDoesNotSayWhatDrives) {
  const std::string variant = "[[variant]]\nname = \"v\"\n";
  const std::string stiffer = variant + "tissue = { young_kpa = 400 }\n";
  const Scene scene = scene_of(smallest + stiffer);
  EXPECT_EQ(scene.drive.by, DriveBy::muscles);
  EXPECT_EQ(scene.variants.at(0).scene.drive.by, DriveBy::muscles);
  EXPECT_EQ(echoed_options(scene).at("drive").at("by"), "muscles");
  EXPECT_EQ(scene_of(smallest + variant + "preset = \"palsy_complete_R\"\n").drive.by,
            DriveBy::muscles);
  // Named, it holds.
  for (const char* by : {"displacement", "reactions"}) {
    const Scene named = scene_of(smallest + stiffer, {std::string("drive.by=") + by});
    EXPECT_NE(named.drive.by, DriveBy::muscles);
    EXPECT_EQ(named.variants.at(0).scene.drive.by, named.drive.by);
    EXPECT_EQ(scene_of(smallest + std::string("[drive]\nby = \"") + by + "\"\n" + stiffer).drive.by,
              named.drive.by);
  }
  // What has a meaning for displacement alone, in the scene or in a variant.
  const std::vector<std::string> keys = {"support.field_kpa_per_mm = 2",
                                         "region.measured = \"all\"", "drive.by = \"reactions\""};
  for (const std::string& key : keys)
    EXPECT_EQ(scene_of(smallest + variant + key + "\n").drive.by, DriveBy::displacement) << key;
  EXPECT_EQ(scene_of(smallest + stiffer, {"support.field_kpa_per_mm=2"}).drive.by,
            DriveBy::displacement);
}

TEST(MuscleKeys, KeysThatMusclesUseOrThatHaveNoEffectDecideNothing) {
  const std::string stiffer = "[[variant]]\nname = \"v\"\ntissue = { young_kpa = 400 }\n";
  for (const char* key :
       {"support.border=free", "support.skull=held", "support.mandible=free",
        "support.jaw_points=[\"Chin\"]", "region.measured=none", "region.blend_mm=100",
        "region.measured_radius_mm=20", "region.measured_points=[\"ibug68_8\"]"})
    EXPECT_EQ(scene_of(smallest + stiffer, {key}).drive.by, DriveBy::muscles) << key;
  for (const char* key :
       {"support.field_kpa_per_mm=2", "support.skull_across_kpa_per_mm=2",
        "support.skull_along_kpa_per_mm=2", "support.mandible_across_kpa_per_mm=2",
        "support.mandible_along_kpa_per_mm=2", "region.measured=all"})
    EXPECT_EQ(scene_of(smallest + stiffer, {key}).drive.by, DriveBy::displacement) << key;
}

TEST(MuscleKeys, GainsAreATableOfNamesAndNumbers) {
  EXPECT_THAT(scene_of(by_muscles).muscles.gains, IsEmpty());
  const Scene scene = scene_of(by_muscles +
                               "[muscles]\nmirrored = true\n"
                               "gain = { zygomatic_R = 0, zyg_major_L = 0.3, side_L = 5 }\n");
  EXPECT_TRUE(scene.muscles.mirrored);
  EXPECT_THAT(scene.muscles.gains,
              ElementsAre(MuscleGain{"side_L", 5}, MuscleGain{"zyg_major_L", 0.3},
                          MuscleGain{"zygomatic_R", 0}));
  EXPECT_THAT(scene_of(by_muscles + "[muscles.gain]\nside_R = 0.5\n").muscles.gains,
              ElementsAre(MuscleGain{"side_R", 0.5}));
  EXPECT_THAT(
      scene_of(by_muscles + "[muscles.gain]\nside_R = 0.5\n", {"muscles.gain={ malaris_L = 0.25 }"})
          .muscles.gains,
      ElementsAre(MuscleGain{"malaris_L", 0.25}))
      << "--set takes the place of the table";
}

TEST(MuscleKeys, GainsNeedNoDriveToBeNamed) {
  const std::string weak = "[muscles]\ngain = { side_L = 0.5 }\n";
  EXPECT_THAT(scene_of(smallest + weak).muscles.gains, ElementsAre(MuscleGain{"side_L", 0.5}))
      << "muscles drive by default";
  EXPECT_THAT(only_muscle_problem(smallest + weak, {"drive.by=displacement"}),
              HasSubstr("muscles move nothing otherwise"));
  EXPECT_THAT(only_muscle_problem(smallest + weak, {"support.field_kpa_per_mm=2"}),
              HasSubstr("muscles move nothing otherwise"));
}

TEST(MuscleKeys, ANameThatIsNoneIsToldWithTheNearest) {
  EXPECT_EQ(only_muscle_problem(by_muscles + "[muscles]\ngain = { zyg_mayor_L = 0.3 }\n"),
            "scene.toml:8: muscles.gain.zyg_mayor_L = 0.3: expected another name; did you mean "
            "zyg_major_L?");
  EXPECT_EQ(only_muscle_problem(by_muscles, {"muscles.gain={ side_l = 0.3 }"}),
            "--set: muscles.gain.side_l = 0.3: expected another name; did you mean side_L?");
  EXPECT_THAT(only_muscle_problem(by_muscles, {"muscles.gain={ zygomaticus_R = 0.3 }"}),
              HasSubstr("did you mean zyg_major_R or zyg_minor_R?"));
  EXPECT_THAT(
      only_muscle_problem(by_muscles + "[muscles]\ngain = { weather = 1 }\n"),
      HasSubstr("muscles.gain.weather = 1: expected a side or a branch of the facial nerve, "
                "one of side_R, side_L, "));
}

TEST(MuscleKeys, APercentageIsToldAsAFactor) {
  EXPECT_EQ(only_muscle_problem(by_muscles, {"muscles.gain={ zyg_major_L = 30 }"}),
            "--set: muscles.gain.zyg_major_L = 30: expected a number from 0 to 5 (0.3 for 30 %)");
  EXPECT_THAT(only_muscle_problem(by_muscles, {"muscles.gain={ zyg_major_L = -1 }"}),
              Not(HasSubstr("%")));
}

TEST(MuscleKeys, ADecimalCommaIsToldAsSuch) {
  for (const char* line : {"[muscles]\ngain = { zyg_major_L = 0,3 }\n",
                           "[muscles]\ngain.zyg_major_L = 0,3\n", "[time]\nend_s = -1,5 # s\n"})
    EXPECT_THAT(only_muscle_problem(by_muscles + line),
                HasSubstr(":8: expected decimals behind a point, 0.3 and not 0,3"))
        << line;
  EXPECT_THAT(only_muscle_problem(by_muscles + "[drive]\nlist = [1,2\n"),
              Not(HasSubstr("decimals")));
}

// motion.gain is only one typing error away too, but its section is another.
TEST(MuscleKeys, AMisspeltSectionIsNotTakenForAnother) {
  const auto meant = HasSubstr("did you mean muscles.gain?");
  EXPECT_THAT(only_muscle_problem(by_muscles, {"muscle.gain={ side_L = 0.3 }"}), meant);
  EXPECT_THAT(only_muscle_problem(by_muscles + "[[variant]]\nname = \"v\"\n"
                                               "muscle.gain = { side_L = 0.3 }\n"),
              meant);
  EXPECT_THAT(only_muscle_problem(by_muscles + "[[variant]]\nname = \"v\"\n"
                                               "muscle.gain.side_L = 0.3\n"),
              meant);
  for (const char* name : {"muscle.gain.side_L", "muscles.gain.side_L"})
    EXPECT_THAT(only_muscle_problem(by_muscles, {std::string(name) + "=0.3"}),
                HasSubstr("did you mean muscles.gain={side_L=...}?"));
  EXPECT_EQ(only_muscle_problem(by_muscles + "[muscle]\ngain = { side_L = 0.3 }\n"),
            "scene.toml:7: muscle: expected a known section (did you mean [muscles]?)");
}

// A name in words gets the names that it may mean, and no truncated list, also in an inline table.
TEST(MuscleKeys, ANameInWordsIsToldWithWhatItMeans) {
  const auto reported = [](const std::string& name) {
    return only_muscle_problem(by_muscles + "[muscles]\ngain = { " + name + " = 0.4 }\n");
  };
  for (const char* name : {"right", "right_side", "sideR", "side_right", "Right"})
    EXPECT_THAT(reported(name), HasSubstr("did you mean side_R?")) << name;
  EXPECT_THAT(reported("side"), HasSubstr("did you mean side_R or side_L?"));
  EXPECT_THAT(reported("zygomatic"), HasSubstr("did you mean zygomatic_R or zygomatic_L?"));
  EXPECT_THAT(reported("left_zygomatic_branch"), HasSubstr("did you mean zygomatic_L?"));
  EXPECT_THAT(reported("frontalis"), HasSubstr("did you mean frontal_med_R or frontal_med_L or "));
  EXPECT_THAT(reported("zyg_major"), HasSubstr("did you mean zyg_major_R or zyg_major_L?"));
  EXPECT_THAT(reported("nobody"), HasSubstr("cervical_L; or a muscle, such as "));
  EXPECT_THAT(reported("nobody"), Not(HasSubstr("...")));
}

const std::string own_muscles =
    "[[muscle]]\nname = \"zyg_major\"\nbranch = \"zygomatic\"\n"
    "path = [\"45 (9, -30) d1\", \"54 (1, 1) d0.4\"]\nwidth_mm = 9\n"
    "[[muscle]]\nname = \"graft\"\npath = [\"45 d1\", \"54 d0.4\"]\n";

TEST(MuscleKeys, OwnMusclesReplaceAddAndLeaveOut) {
  const std::size_t count = muscles::muscle_template().size();
  EXPECT_THAT(scene_of(by_muscles).muscles.own, IsEmpty()) << "the program's";
  const SceneFolder folder;
  folder.write("own.toml", own_muscles);
  const Scene scene = read_scene(folder.write(
      "scene.toml", by_muscles + "[muscles]\nfile = \"own.toml\"\nwithout = [\"risorius\"]\n"
                                 "gain = { graft_R = 0.5, zygomatic_L = 0.5 }\n"
                                 "[[variant]]\nname = \"cut\"\nmuscles.gain = { graft_R = 0 }\n"));
  const muscles::MuscleTable& own = scene.muscles.table();
  ASSERT_EQ(own.size(), count) << "one more and one less";
  EXPECT_EQ(muscles::find_muscle("zyg_major", own)->width_mm, 9);
  EXPECT_NE(muscles::find_muscle("graft", own), nullptr);
  EXPECT_EQ(muscles::find_muscle("risorius", own), nullptr);
  EXPECT_EQ(scene.variants[0].scene.muscles.own, own);
}

TEST(MuscleKeys, MistakesInOwnMusclesAreTold) {
  const SceneFolder folder;
  folder.write("own.toml", own_muscles);
  folder.write("torn.toml", "[[muscle]]\nname = \"graft\"\npath = [\"45 d1\"]\n");
  const auto problem = [&](const std::string& section) {
    const auto problems =
        problems_of(folder.write("scene.toml", by_muscles + "[muscles]\n" + section));
    return problems.size() == 1 ? problems[0].sentence() : sentences(problems);
  };
  EXPECT_THAT(problem("file = \"torn.toml\"\n"),
              AllOf(HasSubstr("scene.toml:8: muscles.file"), HasSubstr("muscle graft: path: ")));
  EXPECT_THAT(problem("without = [\"risorios\"]\n"),
              AllOf(HasSubstr("risorios is none"), HasSubstr("did you mean risorius?")));
  EXPECT_THAT(problem("file = \"own.toml\"\ngain = { graff_R = 0.5 }\n"),
              HasSubstr("scene.toml:9: muscles.gain.graff_R = 0.5: expected another name; did you "
                        "mean graft_R?"));
  EXPECT_THAT(problem("without = [\"risorius\"]\ngain = { risorius_R = 0.5 }\n"),
              HasSubstr("muscles.gain.risorius_R"))
      << "left out";
  EXPECT_THAT(only_muscle_problem(std::string(smallest) + "[muscles]\nwithout = [\"risorius\"]\n",
                                  {"drive.by=displacement"}),
              HasSubstr("expected drive.by = \"muscles\" in the scene"));
  EXPECT_THAT(only_muscle_problem(std::string(smallest) + "[muscles]\nshape_prior = false\n",
                                  {"drive.by=displacement"}),
              HasSubstr("expected drive.by = \"muscles\" in the scene"));
  EXPECT_THAT(problem("[[variant]]\nname = \"other\"\nmuscles.shape_prior = false\n"),
              HasSubstr("variant[0].muscles.shape_prior"));
  EXPECT_THAT(problem("[[variant]]\nname = \"other\"\nmuscles.without = [\"risorius\"]\n"),
              HasSubstr("variant[0].muscles.without"));
}

TEST(MuscleKeys, AFactorIsANumberFrom0To5) {
  for (const char* bad : {"-0.1", "5.1", "\"weak\"", "true", "nan"})
    EXPECT_THAT(only_muscle_problem(by_muscles + "[muscles]\ngain = { side_R = " + bad + " }\n"),
                HasSubstr("expected a number from 0 to 5"))
        << bad;
  for (const char* bad : {"0.5", "[0.5]", "\"side_R\""})
    EXPECT_THAT(only_muscle_problem(by_muscles + "[muscles]\ngain = " + bad + "\n"),
                HasSubstr("expected a table of names and numbers from 0 to 5"))
        << bad;
  EXPECT_THAT(only_muscle_problem(by_muscles, {"muscles.mirrored=3"}),
              HasSubstr("muscles.mirrored = 3"));
}

TEST(MuscleKeys, NeedMusclesThatDrive) {
  EXPECT_THAT(
      only_muscle_problem(smallest, {"drive.by=displacement", "muscles.gain={ side_R = 0.5 }"}),
      HasSubstr("expected drive.by = \"muscles\" in the scene"));
  EXPECT_THAT(only_muscle_problem(smallest, {"drive.by=reactions", "muscles.mirrored=true"}),
              HasSubstr("muscles.mirrored = true: expected drive.by = \"muscles\""));
}

TEST(MuscleKeys, VaryAndBelongToTheVariant) {
  const std::string variant = "[[variant]]\nname = \"palsy\"\n[variant.muscles]\n";
  const Scene scene = scene_of(by_muscles + "[muscles.gain]\nside_L = 0.9\n" + variant +
                               "gain = { zygomatic_R = 0.25 }\n");
  ASSERT_EQ(scene.variants.size(), 1u);
  EXPECT_THAT(scene.variants[0].scene.muscles.gains, ElementsAre(MuscleGain{"zygomatic_R", 0.25}));
  EXPECT_THAT(scene.muscles.gains, ElementsAre(MuscleGain{"side_L", 0.9}));
  EXPECT_THAT(
      only_muscle_problem(std::string(smallest) + variant + "gain = { zygomatic_R = 0.25 }\n",
                          {"drive.by=displacement"}),
      HasSubstr("expected drive.by = \"muscles\" in the scene"));
  EXPECT_THAT(only_muscle_problem(by_muscles + variant + "gain = { zygomatik_R = 0.25 }\n"),
              HasSubstr("did you mean zygomatic_R"));
}

TEST(MuscleKeys, AreEchoed) {
  const SceneFolder folder;
  const Scene scene = read_scene(folder.write(
      "scene.toml", by_muscles + "[muscles]\ngain = { side_R = 0.5, malaris_L = 2 }\n"));
  const auto options = echoed_options(scene);
  EXPECT_EQ(options.at("drive").at("by"), "muscles");
  EXPECT_EQ(options.at("muscles").at("gain"), (nlohmann::json{{"side_R", 0.5}, {"malaris_L", 2}}));
  EXPECT_EQ(options.at("muscles").at("mirrored"), false);
  const Scene plain = read_scene(folder.write("plain.toml", smallest));
  EXPECT_EQ(echoed_options(plain).at("muscles").at("gain"), nlohmann::json::object());
}

TEST(MuscleKeys, MovedBonesAndAddedVolumeNeedForces) {
  const std::string bone = "[surgery]\nbone = [{ part = \"chin\", move_mm = [0, 0, 4] }]\n",
                    volume = "[[tissue.region]]\nname = \"lips\"\nvolume_ml = 1\n";
  for (const auto& [text, key] : {std::pair{&bone, "surgery.bone"}, {&volume, "tissue.region"}}) {
    EXPECT_THAT(only_muscle_problem(smallest + *text, {"drive.by=displacement"}),
                AllOf(HasSubstr(key), HasSubstr("expected drive.by = \"muscles\"")));
    for (const char* by : {"muscles", "reactions"})
      EXPECT_NO_THROW(scene_of(smallest + *text, {std::string("drive.by=") + by}));
    EXPECT_NO_THROW(scene_of(smallest + *text)) << "what drives is chosen later";
  }
  EXPECT_NO_THROW(
      scene_of(smallest + std::string("[[tissue.region]]\nname = \"lips\"\nyoung_factor = 2\n"),
               {"drive.by=displacement"}));
}

TEST(MuscleKeys, ABoneIsCutAsItsPartCanBe) {
  const auto with = [](const std::string& part, const std::string& cut) {
    return smallest + std::string("[surgery]\nbone = [{ part = \"chin\" }, { part = \"") + part +
           "\", cut = \"" + cut + "\" }]\n";
  };
  EXPECT_EQ(only_muscle_problem(with("maxilla", "bsso")),
            "scene.toml:6: surgery.bone[1].cut = \"bsso\": expected standard or le_fort_1 for the "
            "maxilla");
  EXPECT_THAT(only_muscle_problem(with("mandible", "le_fort_1")),
              HasSubstr("expected standard or bsso, or whole, for the mandible"));
  EXPECT_THAT(
      only_muscle_problem(smallest + std::string("[[variant]]\nname = \"v\"\nbone = [{ part "
                                                 "= \"chin\", cut = \"whole\" }]\n")),
      HasSubstr("scene.toml:7: variant[0].surgery.bone[0].cut"));
  for (const char* cut : {"standard", "whole", "bsso"})
    EXPECT_NO_THROW(scene_of(with("mandible", cut))) << cut;
}

TEST(MuscleKeys, ARegionThatIsMeasuredIsRefused) {
  for (const char* by : {"muscles", "reactions"}) {
    const std::string drive = std::string("drive.by=") + by;
    EXPECT_THAT(only_muscle_problem(smallest, {drive, "region.measured=points",
                                               "region.measured_points=[\"ibug68_8\"]"}),
                HasSubstr("region.measured = \"points\": expected \"none\", as drive.by is not"));
    EXPECT_THAT(only_muscle_problem(smallest, {drive, "region.measured=all"}),
                HasSubstr("region.measured = \"all\": expected \"none\""));
  }
}

Scene variant_of(const std::string& preset, const std::string& more = "") {
  const Scene scene =
      scene_of(by_muscles + "[[variant]]\nname = \"v\"\npreset = \"" + preset + "\"\n" + more);
  return scene.variants.at(0).scene;
}

TEST(VariantPresets, StandForKeysOfASide) {
  EXPECT_THAT(variant_of("palsy_complete_R").muscles.gains, ElementsAre(MuscleGain{"side_R", 0}));
  EXPECT_THAT(variant_of("palsy_complete_L").muscles.gains, ElementsAre(MuscleGain{"side_L", 0}));
  EXPECT_THAT(variant_of("palsy_partial_L").muscles.gains, ElementsAre(MuscleGain{"side_L", 0.4}));
  EXPECT_THAT(variant_of("palsy_zygomatic_L").muscles.gains,
              ElementsAre(MuscleGain{"zygomatic_L", 0}));
  const auto regions = variant_of("scar_cheek_L").tissue.regions;
  ASSERT_EQ(regions.size(), 1u);
  EXPECT_THAT(regions[0].scar, ElementsAre("cheek_L", "cheilion_L"));
  EXPECT_EQ(regions[0].factor[tissue::young], 5);
  EXPECT_EQ(variant_of("aged").tissue.preset, "aged_skin");
}

TEST(VariantPresets, KeysOfTheVariantReplaceThoseOfItsPreset) {
  const Scene own = variant_of("palsy_complete_R", "muscles.gain = { zyg_major_R = 0.5 }\n");
  EXPECT_THAT(own.muscles.gains, ElementsAre(MuscleGain{"zyg_major_R", 0.5}));
  const Scene both = variant_of("palsy_complete_R", "tissue = { young_kpa = 50 }\n");
  EXPECT_THAT(both.muscles.gains, ElementsAre(MuscleGain{"side_R", 0}));
  EXPECT_EQ(both.tissue.uniform[tissue::young], 50e3);
}

TEST(VariantPresets, AreEchoedAsWhatTheyChange) {
  const Scene scene =
      scene_of(by_muscles + "[[variant]]\nname = \"v\"\npreset = \"palsy_partial_R\"\n");
  EXPECT_EQ(scene.variants.at(0).changes.dump(), R"({"muscles.gain":{"side_R":0.4}})");
}

TEST(VariantPresets, AreSoundAndSayWhereTheyComeFrom) {
  ASSERT_EQ(variant_presets().size(), 15u);
  for (const VariantPreset& preset : variant_presets()) {
    EXPECT_NO_THROW(variant_of(preset.name)) << preset.name;
    EXPECT_GT(preset.source.size(), 20u) << preset.name;
    EXPECT_GT(preset.assumed.size(), 20u) << preset.name;
  }
}

TEST(VariantPresets, UnknownOnesAndThoseThatMoveNothingAreRefused) {
  const std::string variant = "[[variant]]\nname = \"v\"\npreset = ";
  EXPECT_THAT(only_muscle_problem(by_muscles + variant + "\"palsy_complet_R\"\n"),
              HasSubstr("scene.toml:9: variant[0].preset = \"palsy_complet_R\": expected "));
  EXPECT_THAT(only_muscle_problem(by_muscles + variant + "\"palsy_complet_R\"\n"),
              HasSubstr("palsy_complete_R"));
  EXPECT_THAT(only_muscle_problem(by_muscles + variant + "7\n"),
              HasSubstr("variant[0].preset = 7"));
  EXPECT_THAT(
      only_muscle_problem(smallest + variant + "\"palsy_complete_R\"\n", {"drive.by=displacement"}),
      HasSubstr("drive.by = \"muscles\" in the scene"));
}

}  // namespace
}  // namespace hyperex::scene
