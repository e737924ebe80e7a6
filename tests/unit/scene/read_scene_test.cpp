// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "hyperex/scene/keys.hpp"
#include "hyperex/scene/variant_presets.hpp"
#include "hyperex/tissue/field/tissue_field.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::scene {
namespace {
using testing::HasSubstr;

/// The one problem of a scene text, as its sentence without the folder.
std::string only_problem(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const SceneFolder folder;
  const auto problems = problems_of(folder.write("scene.toml", text), overrides);
  EXPECT_EQ(problems.size(), 1u) << sentences(problems);
  std::string sentence = problems.empty() ? "" : problems[0].sentence();
  const std::string prefix = (folder / "").string();
  for (auto at = sentence.find(prefix); at != std::string::npos; at = sentence.find(prefix))
    sentence.erase(at, prefix.size());
  return sentence;
}

TEST(ReadScene, SmallestSceneHasTheDefaults) {
  const SceneFolder folder;
  const Scene scene = read_scene(folder.write("scene.toml", smallest));
  EXPECT_TRUE(scene.scan.source.embedded);
  EXPECT_EQ(tissue::uniform_parameters(scene.tissue)[tissue::young], 192400);
  EXPECT_EQ(scene.drive.points.size(), 7u);
  EXPECT_EQ(scene.file, folder / "scene.toml");
  EXPECT_EQ(scene.origins.size(), 2u);
}

TEST(ReadScene, PathsAreRelativeToTheSceneFileThoseOfSetToTheCurrentFolder) {
  const SceneFolder folder;
  const auto file = folder.write("sub/scene.toml",
                                 "[scan]\nfile = \"../face.ply\"\nlandmarks = \"../points.json\"\n"
                                 "[motion]\nfile = \"embedded\"\n");
  EXPECT_EQ(read_scene(file).scan.source.file, folder / "face.ply");
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder / "");
  const Scene moved = read_scene(file, {"scan.file=sub/../motion.csv", "motion.file=motion.csv"});
  const auto wrong = problems_of(file, {"scan.file=../face.ply"});
  std::filesystem::current_path(before);
  EXPECT_EQ(moved.scan.source.file, "motion.csv");
  EXPECT_EQ(moved.scan.landmarks, folder / "points.json");
  EXPECT_EQ(wrong.size(), 1u);
}

TEST(ReadScene, WrongNamesInTwoVariantsAreThrownAtOnce) {
  const SceneFolder folder;
  const auto problems = problems_of(
      folder.write("scene.toml", std::string(smallest) +
                                     "[[variant]]\nname = \"a\"\nmuscles.gain = { zyg_R = 0.3 }\n"
                                     "[[variant]]\nname = \"b\"\n"
                                     "tissue.region = [{ name = \"side_R\", young_factor = 5 }]\n"),
      {});
  ASSERT_EQ(problems.size(), 2u) << sentences(problems);
  EXPECT_EQ(problems[0].key, "variant[0].muscles.gain.zyg_R");
  EXPECT_EQ(problems[1].key, "variant[1].tissue.region[0].name");
  EXPECT_THAT(problems[1].expected, HasSubstr("did you mean face_R?"));
}

TEST(ReadScene, AllProblemsAreThrownAtOnceEachOnItsLine) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml",
                                 "[scan]\n"
                                 "file = \"gone.ply\"\n"
                                 "[time]\n"
                                 "setp_s = 0.01\n"
                                 "step_s = 0\n"
                                 "[tissue]\n"
                                 "young_kpa = \"stiff\"\n");
  try {
    read_scene(file, {"mesh.layers=9", "nonsense"});
    FAIL() << "nothing was thrown";
  } catch (const InputError& error) {
    const std::string name = file.string(), text = error.what();
    EXPECT_THAT(text, HasSubstr(name + ":2: scan.file = \"gone.ply\": expected an existing file"));
    EXPECT_THAT(text, HasSubstr(name + ":4: time.setp_s = 0.01: expected a known key (did you mean "
                                       "time.step_s?)"));
    EXPECT_THAT(text,
                HasSubstr(name + ":5: time.step_s = 0: expected a number from 1e-06 to 0.1 (s)"));
    EXPECT_THAT(text,
                HasSubstr(name + ":7: tissue.young_kpa = \"stiff\": expected a number from 0.001 "
                                 "to 1e+06 (kPa)"));
    EXPECT_THAT(text,
                HasSubstr("motion.file: expected the path of a file, or \"embedded\", required"));
    EXPECT_THAT(text, HasSubstr("--set: mesh.layers = 9: expected an integer from 1 to 8"));
    EXPECT_THAT(text, HasSubstr("--set: \"nonsense\": expected KEY=VALUE"));
    EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 6);
  }
}

TEST(ReadScene, TakesOneSourceOfMotion) {
  const std::string scan = "[scan]\nfile = \"embedded\"\n";
  EXPECT_EQ(only_problem(scan + "[motion]\nfile = \"motion.csv\"\narkit = \"motion.csv\"\n"),
            "scene.toml:5: motion.arkit = \"motion.csv\": expected one source of motion, and "
            "motion.file is given");
  EXPECT_EQ(only_problem(scan),
            "scene.toml: motion.file: expected the path of a file, or "
            "\"embedded\", required; or motion.recording, motion.openface or motion.arkit "
            "in its place");
  const SceneFolder folder;
  const std::string csv = (folder / "motion.csv").string();
  const auto file = folder.write("scene.toml", scan + "[motion]\nopenface = \"motion.csv\"\n");
  EXPECT_EQ(read_scene(file).motion.openface, csv);
  EXPECT_TRUE(read_scene(file).motion.source.file.empty());
  const Scene other = read_scene(file, {"motion.arkit=" + csv});
  EXPECT_EQ(other.motion.arkit, csv);
  EXPECT_TRUE(other.motion.openface.empty()) << "an override takes its place";
}

TEST(ReadScene, UnknownKeysAndSections) {
  const std::string base = smallest;
  EXPECT_EQ(only_problem(base + "[tissue]\nyoungs_kpa = 3\n"),
            "scene.toml:6: tissue.youngs_kpa = 3: expected a known key (did you mean "
            "tissue.young_kpa?)");
  EXPECT_EQ(only_problem(base + "[tisue]\nyoung_kpa = 3\n"),
            "scene.toml:5: tisue: expected a known section (did you mean [tissue]?)");
  EXPECT_EQ(only_problem("titel = \"x\"\n" + base),
            "scene.toml:1: titel = \"x\": expected a known key (did you mean title?)");
  EXPECT_EQ(only_problem("mesh = 4\n" + base),
            "scene.toml:1: mesh = 4: expected a section, [mesh]");
  EXPECT_THAT(only_problem(base + "[time]\nweather = 1\n"),
              HasSubstr("[time] has start_s, step_s, end_s, frame_rate_hz"));
  EXPECT_EQ(only_problem(base, {"tissue.young_pa=5"}),
            "--set: tissue.young_pa = 5: expected a known key (did you mean tissue.young_kpa?)");
  EXPECT_THAT(
      only_problem(base, {"tissue.yeoh_c10_kpa=2.5"}),
      HasSubstr("expected what it follows from: tissue.young_kpa = 4 (1 + tissue.poisson) C10"));
  EXPECT_THAT(only_problem(base, {"tissue.yeoh_c20_kpa=1.175"}),
              HasSubstr("tissue.yeoh_c20 = C20 / C10"));
  EXPECT_THAT(only_problem(base, {"tissue.shear_modulus_kpa=5"}),
              HasSubstr("2 (1 + tissue.poisson) mu"));
  for (const auto& [text, set] : {std::pair(base + "[support]\nmuscle_kpa_per_mm = 2\n", ""),
                                  std::pair(base, "support.muscle_kpa_per_mm=2")})
    EXPECT_THAT(
        only_problem(text, *set ? std::vector<std::string>{set} : std::vector<std::string>{}),
        HasSubstr("support.muscle_kpa_per_mm = 2: expected its new name: "
                  "support.muscle_kpa_per_mm is now support.field_kpa_per_mm"));
  EXPECT_EQ(only_problem(base + "[output]\ncontact_times_s = [0, 1]\n"),
            "scene.toml:6: output.contact_times_s = [0, 1]: expected its new name: "
            "output.contact_times_s is now output.picture_times_s");
  EXPECT_THAT(only_problem(base, {"solver.linear=\"iterative\""}),
              HasSubstr("expected no such key: it was removed"));
  EXPECT_THAT(only_problem(base, {"tissue={young_kpa=3}"}), HasSubstr("tissue.KEY=VALUE"));
  EXPECT_THAT(only_problem(base + "\"a\\nb\" = 1\n"), HasSubstr("a\\nb"));
}

TEST(ReadScene, RowsOfTables) {
  const std::string head = std::string(smallest) + "[[mesh.thickness_point]]\nlandmark = \"a\"\n";
  EXPECT_EQ(only_problem(head),
            "scene.toml:5: mesh.thickness_point[0].thickness_mm: expected a number from 1 to 40 "
            "(mm), required");
  EXPECT_EQ(only_problem(head + "thickness_mm = 90\n"),
            "scene.toml:7: mesh.thickness_point[0].thickness_mm = 90: expected a number from 1 to "
            "40 (mm)");
  EXPECT_EQ(only_problem(head + "thickness_mm = 9\nthicknes_mm = 9\n"),
            "scene.toml:8: mesh.thickness_point[0].thicknes_mm = 9: expected a known key (did you "
            "mean thickness_mm?)");
  EXPECT_THAT(only_problem(std::string(smallest) + "[mesh.thickness_point]\nlandmark = \"a\"\n"),
              HasSubstr("expected [[mesh.thickness_point]] tables"));
  EXPECT_THAT(only_problem(head + "thickness_mm = 9\n", {"mesh.thickness_mm=8"}),
              HasSubstr("--set: mesh.thickness_mm = 8: expected 0, as"));
}

TEST(ReadScene, Lists) {
  const std::string base = smallest;
  EXPECT_EQ(only_problem(base + "[drive]\npoints = [\n\"a\",\n\"b\",\n\"a\"]\n"),
            "scene.toml:9: drive.points[2] = \"a\": expected each name once");
  EXPECT_THAT(only_problem(base, {"drive.points=some"}), HasSubstr("or \"all\""));
  EXPECT_THAT(only_problem(base, {"drive.points=[]"}), HasSubstr("one or more names, or \"all\""));
  EXPECT_THAT(only_problem(base, {"drive.points=[\"\"]"}), HasSubstr("a name in quotes"));
  EXPECT_THAT(only_problem(base, {"motion.rigid_points=[\"a\", \"b\"]"}),
              HasSubstr("expected a list of 3 or more different names, or none"));
  EXPECT_THAT(only_problem(base, {"output.picture_times_s=[0, 2, 1]"}),
              HasSubstr("output.picture_times_s[2] = 1: expected a number above the one before"));
  EXPECT_THAT(only_problem(base, {"output.picture_times_s=[0, nan]"}), HasSubstr("[1] = nan"));
}

TEST(ReadScene, VariantsAreTheSceneWithTheirChanges) {
  const SceneFolder folder;
  const Scene scene = read_scene(
      folder.write("scene.toml", std::string(smallest) + "[tissue]\npoisson = 0.3\n"
                                                         "[[variant]]\nname = \"stiff\"\n"
                                                         "tissue = { young_kpa = 400 }\n"
                                                         "[[variant]]\nname = \"more of it\"\n"
                                                         "[variant.motion]\ngain = 2\n"));
  ASSERT_EQ(scene.variants.size(), 2u);
  EXPECT_EQ(tissue::uniform_parameters(scene.tissue)[tissue::young], 192400);
  EXPECT_EQ(scene.variants[0].name, "stiff");
  EXPECT_EQ(scene.variants[0].scene.tissue.uniform[tissue::young], 400e3);
  EXPECT_EQ(scene.variants[0].scene.tissue.uniform[tissue::poisson], 0.3);
  EXPECT_EQ(scene.variants[0].scene.drive.gain, 1);
  EXPECT_EQ(scene.variants[0].changes.dump(), "{\"tissue.young_kpa\":400}");
  EXPECT_EQ(scene.variants[1].scene.drive.gain, 2);
  EXPECT_FALSE(scene.variants[1].scene.tissue.uniform[tissue::young]) << "left open";
  EXPECT_TRUE(scene.variants[1].scene.variants.empty());
}

TEST(ReadScene, LipsAreKeptApartWhereEveryFaceHasLinearStrain) {
  const SceneFolder folder;
  const auto lips = [&](const std::string& more, const std::vector<std::string>& overrides = {}) {
    const Scene scene = read_scene(folder.write("scene.toml", smallest + more), overrides);
    for (const Variant& variant : scene.variants) {
      EXPECT_EQ(variant.scene.contact.lips, scene.contact.lips) << "faces are compared";
    }
    EXPECT_EQ(scene.origins.contains("contact.lips"), false) << "nobody gave it";
    return scene.contact.lips;
  };
  const std::string variant = "[[variant]]\nname = \"v\"\n";
  EXPECT_TRUE(lips(""));
  EXPECT_TRUE(lips(variant + "tissue.young_kpa = 400\n"));
  EXPECT_FALSE(lips("[tissue]\nstrain = \"finite\"\n"));
  EXPECT_FALSE(lips("", {"tissue.strain=finite"}));
  EXPECT_FALSE(lips(variant + "tissue.strain = \"finite\"\n"));
  EXPECT_FALSE(lips("[tissue]\nstrain = \"finite\"\n" + variant + "tissue.strain = \"linear\"\n"));
  for (const char* given : {"true", "false"}) {
    const std::string finite = "[tissue]\nstrain = \"finite\"\n";
    for (const std::string& text : {std::string(), finite}) {
      const Scene scene = read_scene(
          folder.write("scene.toml", smallest + text + "[contact]\nlips = " + given + "\n"));
      EXPECT_EQ(scene.contact.lips, given == std::string("true")) << text;
    }
  }
}

TEST(ReadScene, WithoutItsVariantsLipsAreAsInASceneThatHasNone) {
  const SceneFolder folder;
  const auto lips = [&](const std::string& more) {
    Scene scene = read_scene(folder.write(
        "scene.toml", smallest + more + "[[variant]]\nname = \"v\"\ntissue.strain = \"finite\"\n"));
    leave_out_variants(scene);
    EXPECT_TRUE(scene.variants.empty());
    return scene.contact.lips;
  };
  EXPECT_TRUE(lips(""));
  EXPECT_FALSE(lips("[tissue]\nstrain = \"finite\"\n"));
  EXPECT_FALSE(lips("[contact]\nlips = false\n"));
}

TEST(ReadScene, AScanOrARecordingIsNoScene) {
  const SceneFolder folder;
  EXPECT_THAT(
      sentences(problems_of(folder / "face.ply")),
      HasSubstr(
          "this is a scan. hyperex new face.ply MOTION writes one, with scan.file = 'face.ply'"));
  EXPECT_THAT(sentences(problems_of(folder / "motion.csv")),
              HasSubstr("this is a recording. hyperex new SCAN motion.csv writes one, with "
                        "motion.file = 'motion.csv'"));
}

TEST(ReadScene, PathsOfWindowsBelongBetweenSingleQuotes) {
  const std::string scene = "motion = { file = \"embedded\" }\n";
  EXPECT_THAT(only_problem(scene + "scan = { file = \"C:\\Users\\me.ply\" }\n"),
              HasSubstr("put a path of Windows between single quotes, 'C:\\scans\\me.ply'"));
  // What happens to be an escape that there is.
  EXPECT_THAT(only_problem(scene + "scan = { file = \"C:\\new\\table.ply\" }\n"),
              HasSubstr("put a path of Windows between single quotes"));
  EXPECT_THAT(only_problem(scene + "scan = { file = 'C:\\new\\table.ply' }\n"),
              testing::Not(HasSubstr("single quotes")));
  EXPECT_THAT(only_problem(scene + "scan = { file = \n"), testing::Not(HasSubstr("single quotes")));
}

TEST(ReadScene, VariantsThatCannotBe) {
  const std::string base = std::string(smallest) + "[[variant]]\n";
  EXPECT_THAT(only_problem(base + "name = \"a\"\n"),
              HasSubstr("variant[0]: expected at least one key that it changes"));
  EXPECT_THAT(only_problem(base + "tissue = { young_kpa = 4 }\n"),
              HasSubstr("variant[0].name: expected a name in quotes, required"));
  EXPECT_THAT(only_problem(base + "name = \"../a\"\ntissue = { young_kpa = 4 }\n"),
              HasSubstr("variant[0].name = \"../a\""));
  EXPECT_THAT(only_problem(base + "name = \"a\"\ntissue = { young_kpa = -4 }\n"),
              HasSubstr("variant[0].tissue.young_kpa = -4: expected a number from 0.001"));
  EXPECT_THAT(
      only_problem(base + "name = \"a\"\nmesh = { layers = 3 }\ntissue = { young_kpa = 4 }"),
      HasSubstr("variant[0].mesh.layers = 3: expected a key of what may vary: [tissue]"));
  EXPECT_THAT(only_problem(base + "name = \"a\"\ntissue = { yuong_kpa = 4 }\n"),
              HasSubstr("did you mean tissue.young_kpa"));
  const std::string one = "name = \"a\"\ntissue = { young_kpa = 4 }\n";
  EXPECT_THAT(only_problem(base + one + "[[variant]]\n" + one),
              HasSubstr("variant[1].name = \"a\": expected a name that no other variant has"));
}

TEST(ReadScene, WrongVariantsAreLeftOutWhereTheCallerDoesWithoutThem) {
  const std::string text = std::string(smallest) +
                           "[[variant]]\nname = \"a\"\nmuscles.gain = { zyg_R = 0.3 }\n"
                           "[[variant]]\nname = \"b\"\ntissue.young_kpa = 400\n"
                           "[[variant]]\ntissue = { young_kpa = -4 }\n"
                           "[[variant]]\nname = \"a\"\ntissue.young_kpa = 500\n";
  std::vector<LeftOutVariant> left_out;
  const Scene scene = read_scene_text(text, "scene.toml", &left_out);
  ASSERT_EQ(scene.variants.size(), 2u);
  EXPECT_EQ(scene.variants[0].owner(), "variant[1].");
  EXPECT_EQ(scene.variants[1].name, "a") << "the name is free, as the first one is left out";
  EXPECT_EQ(scene.variants[1].number, 3u);
  ASSERT_EQ(left_out.size(), 2u);
  EXPECT_EQ(left_out[0].number, 0u);
  EXPECT_EQ(left_out[0].name, "a");
  EXPECT_THAT(left_out[0].why,
              HasSubstr("scene.toml:7: variant[0].muscles.gain.zyg_R = 0.3: expected"));
  EXPECT_EQ(left_out[1].number, 2u);
  EXPECT_EQ(left_out[1].name, "");
  EXPECT_THAT(left_out[1].why, HasSubstr("variant[2].name: expected a name"));
  EXPECT_THROW(read_scene_text(text, "scene.toml"), InputError);
  EXPECT_THROW(read_scene_text("mesh.layers = -1\n" + text, "scene.toml", &left_out), InputError);
}

/// `hyperex new` writes such a block as a comment.
TEST(ReadScene, AVariantWithoutANameIsCalledAsItsPreset) {
  const SceneFolder folder;
  const std::string palsy = std::string(smallest) + "[[variant]]\npreset = \"palsy_complete_R\"\n";
  const Scene scene = read_scene(folder.write("scene.toml", palsy));
  ASSERT_EQ(scene.variants.size(), 1u);
  EXPECT_EQ(scene.variants[0].name, "palsy_complete_R");
  EXPECT_EQ(scene.variants[0].folder, "palsy_complete_R");
  EXPECT_FALSE(scene.variants[0].scene.muscles.gains.empty());
  EXPECT_THAT(only_problem(palsy + "[[variant]]\npreset = \"palsy_complete_R\"\n"),
              HasSubstr("variant[1].preset = \"palsy_complete_R\": expected a name beside it"));
  EXPECT_THAT(only_problem(std::string(smallest) + "[[variant]]\npreset = \"palsy_complet_R\"\n"),
              HasSubstr("variant[0].preset = \"palsy_complet_R\": expected another name; did you "
                        "mean palsy_complete_R?"));
}

TEST(ReadScene, OfAnUnknownPresetTheMeaningIsSoughtBeforeTheSpelling) {
  EXPECT_EQ(expected_preset("palsy_incomplete_L"), "another name; did you mean palsy_partial_L?");
  EXPECT_EQ(expected_preset("Palsy_Total_right"), "another name; did you mean palsy_complete_R?");
  EXPECT_EQ(expected_preset("palsy_incomplete"),
            "another name; did you mean palsy_partial_R or palsy_partial_L?")
      << "a side is not guessed";
  EXPECT_EQ(expected_preset("agd"), "another name; did you mean aged?");
  for (const char* name : {"", "stroke", "palsy_upper_L"})
    EXPECT_THAT(
        expected_preset(name),
        testing::AllOf(HasSubstr("one of palsy_complete_R, palsy_complete_L, palsy_partial_R"),
                       HasSubstr("scar_cheek_L"), HasSubstr("aged")))
        << name;
}

TEST(ReadScene, VariantsAreLeftOutByAnOptionAndNotByAKey) {
  EXPECT_THAT(only_problem(smallest, {"variant=[]"}),
              HasSubstr("variant = []: expected a key; variants stand in the scene file, and "
                        "--no-variants of hyperex run and hyperex check leaves them out"));
}

TEST(ReadScene, KeysThatDependOnEachOther) {
  const std::string base = smallest;
  EXPECT_THAT(only_problem(base, {"region.measured=points"}),
              HasSubstr("region.measured_points: expected one or more names"));
  EXPECT_THAT(only_problem(base, {"time.end_s=0.001"}), HasSubstr("time.end_s = 0.001"));
  const SceneFolder folder;
  EXPECT_TRUE(problems_of(folder.write("s.toml", base), {"region.measured=all", "drive.points=[]"})
                  .empty());
}

TEST(ReadScene, FilesMustBeFiles) {
  const std::string rest = "landmarks = \"points.json\"\n[motion]\nfile = \"embedded\"\n";
  EXPECT_THAT(only_problem("[scan]\nfile = \"sub\"\n" + rest), HasSubstr("is a folder"));
  EXPECT_THAT(only_problem("[scan]\nfile = \"\"\n" + rest), HasSubstr("the path of a file"));
  EXPECT_THAT(only_problem("[scan]\nfile = 3\n" + rest),
              HasSubstr("scan.file = 3: expected the path of a file, or \"embedded\""));
}

TEST(ReadScene, TornFilesGiveTheLine) {
  EXPECT_THAT(only_problem("[scan]\nfile = \"embed"),
              HasSubstr("scene.toml:2: expected sound TOML"));
  EXPECT_THAT(only_problem("[scan]\nfile = 1\nfile = 2\n"), HasSubstr("scene.toml:3: "));
  EXPECT_THAT(only_problem("[scan]\n\xff\xfe = 1\n"), HasSubstr("sound TOML"));
  EXPECT_THAT(only_problem(std::string("\0\0\0", 3)), HasSubstr("scene.toml:1: "));
  EXPECT_THAT(only_problem(std::string(5000, '[')), HasSubstr("sound TOML"));
}

TEST(ReadScene, EveryShorterFileIsReadOrRefusedCleanly) {
  const SceneFolder folder;
  const std::string whole =
      "title = \"x\" # y\n[scan]\nfile = \"embedded\"\nunit = 'mm'\n[motion]\nfile = "
      "\"\"\"embedded\"\"\"\n"
      "[[mesh.thickness_point]]\nlandmark = \"a\"\nthickness_mm = 9.5e0\n[drive]\npoints = [\"a\", "
      "\"b\"]\n[output]\npicture_times_s = [0, 1979-05-27]\n";
  for (std::size_t length = 0; length < whole.size(); ++length) {
    for (const auto& problem : problems_of(folder.write("scene.toml", whole.substr(0, length)))) {
      EXPECT_EQ(problem.sentence().find('\n'), std::string::npos);
      EXPECT_FALSE(problem.expected.empty());
    }
  }
}

TEST(ReadScene, ScrambledFilesDoNotCrash) {
  const SceneFolder folder;
  std::mt19937 random(7);
  const std::string whole = std::string(smallest) + "[drive]\npoints = [\"a\", {b = 1.5}]\n";
  const std::string marks = "[]{}=\".,#'\n0e-_\\\xc3";
  for (int round = 0; round < 600; ++round) {
    std::string text = whole;
    for (int i = 0; i < 3; ++i) text[random() % text.size()] = marks[random() % marks.size()];
    problems_of(folder.write("scene.toml", text), {text.substr(random() % text.size())});
  }
}

TEST(ReadScene, MissingSceneFileIsOneProblem) {
  const SceneFolder folder;
  auto problems = problems_of(folder / "gone.toml", {"mesh.layers=99"});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].sentence(), HasSubstr("gone.toml: expected an existing scene file"));
  problems = problems_of(folder / "sub");
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_THAT(problems[0].sentence(), HasSubstr("this is a folder"));
  EXPECT_THROW(read_scene(folder / "gone.toml"), InputError);
}

TEST(Overrides, TheLastWinsAndTheFilesValueNeedNotBeSound) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml",
                                 "[scan]\nfile = \"gone.ply\"\nlandmarks = \"gone.json\"\n"
                                 "[motion]\nfile = \"embedded\"\n[mesh]\nlayers = 99\n");
  const std::vector<std::string> sound = {"scan.file=" + (folder / "face.ply").string(),
                                          "scan.landmarks=" + (folder / "points.json").string(),
                                          "mesh.layers=98", " mesh.layers = 4"};
  EXPECT_EQ(read_scene(file, sound).mesh.layers, 4);
}

TEST(Overrides, ValuesAreTomlElseBareText) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", smallest);
  EXPECT_EQ(read_scene(file, {"title=two words"}).title, "two words");
  EXPECT_EQ(read_scene(file, {"title=\"two = words\""}).title, "two = words");
  EXPECT_EQ(read_scene(file, {"title=7"}).title, "7");
  EXPECT_EQ(read_scene(file, {"title="}).title, "");
  EXPECT_EQ(read_scene(file, {"time.step_s=1e-3"}).time.step_s, 0.001);
  EXPECT_EQ(read_scene(file, {"title=1\n[time]\nstep_s=1"}).title, "1\n[time]\nstep_s=1");
  // A table as TOML or as JSON.
  for (const char* gain : {"{ side_R = 0.3 }", "{\"side_R\": 0.3}"}) {
    const auto& gains = read_scene(file, {std::string("muscles.gain=") + gain}).muscles.gains;
    ASSERT_EQ(gains.size(), 1u) << gain;
    EXPECT_EQ(gains[0].muscle, "side_R");
    EXPECT_EQ(gains[0].gain, 0.3);
  }
  EXPECT_THAT(sentences(problems_of(file, {"time.step_s=fast"})),
              HasSubstr("--set: time.step_s = \"fast\": expected a number from"));
  for (const char* bad : {"=3", "title", "", "title=\xff"})
    EXPECT_THAT(sentences(problems_of(file, {bad})), HasSubstr("expected KEY=VALUE")) << bad;
}

TEST(ProblemAt, PointsToWhereTheValueWasGiven) {
  const SceneFolder folder;
  const auto file = folder.write("scene.toml", std::string(smallest) +
                                                   "[drive]\npoints = [\"a\",\n  \"b\"]\n"
                                                   "[[mesh.thickness_point]]\nlandmark = \"c\"\n"
                                                   "thickness_mm = 9\n");
  const Scene scene = read_scene(file, {"mesh.layers=3"});
  const auto said = [&](const std::string& key) { return problem_at(scene, key, "X").sentence(); };
  EXPECT_EQ(said("drive.points[1]"), file.string() + ":7: drive.points[1] = \"b\": expected X");
  EXPECT_EQ(said("mesh.thickness_point[0].landmark"),
            file.string() + ":9: mesh.thickness_point[0].landmark = \"c\": expected X");
  EXPECT_EQ(said("mesh.layers"), "--set: mesh.layers = 3: expected X");
  EXPECT_EQ(said("time.step_s"), file.string() + ": time.step_s = 0.002: expected X");
  EXPECT_EQ(said("drive.points[9]"), file.string() + ":6: drive.points[9]: expected X");
}

TEST(OptionsJson, HoldsEveryKeyAndReadsBackAsTheSameScene) {
  const SceneFolder folder;
  const Scene scene = read_scene(folder.write("scene.toml", smallest),
                                 {"mesh.element_size_mm=4.1", "tissue.young_kpa=0.3",
                                  "drive.points=all", "support.skull=free"});
  const nlohmann::json options = options_json(scene);
  EXPECT_EQ(options["mesh"]["element_size_mm"], 4.1);
  EXPECT_EQ(options["tissue"]["young_kpa"], 0.3);
  EXPECT_EQ(options["title"], "");
  Scene again;
  for (const Key& key : keys()) {
    const std::string section = section_of(key.name);
    const auto& value = section.empty()
                            ? options.at(key.name)
                            : options.at(section).at(key.name.substr(section.size() + 1));
    if (key.kind == Kind::path && value == "") continue;  // none
    EXPECT_TRUE(key.set(again, value, {}).empty()) << key.name;
  }
  EXPECT_EQ(options_json(again), options);
}

TEST(ReadScene, FiniteStrainRefusesWhatItHasNoMeaningForEachInOneLine) {
  const auto of = [](const std::string& more) {
    return only_problem(std::string(smallest) + "[tissue]\nstrain = \"finite\"\n" + more);
  };
  for (const auto& [more, problem] : std::vector<std::pair<const char*, const char*>>{
           {"viscous_form = \"printed\"",
            "scene.toml:7: tissue.viscous_form = \"printed\": expected \"isotropic\", as "
            "tissue.strain is \"finite\""},
           {"[drive]\nby = \"reactions\"",
            "scene.toml:8: drive.by = \"reactions\": expected \"displacement\" or \"muscles\", as "
            "tissue.strain is \"finite\""},
           {"law = \"yeoh\"\nyeoh_c20 = -0.5",
            "scene.toml:8: tissue.yeoh_c20 = -0.5: expected at least 0, -sqrt(3 tissue.yeoh_c30)"},
           {"law = \"yeoh\"\nyeoh_c20 = -1.8\nyeoh_c30 = 1",
            "scene.toml:8: tissue.yeoh_c20 = -1.8: expected at least -1.73205"},
           {"yeoh_c30 = -1", "tissue.yeoh_c30 = -1: expected a number from 0 to 100"},
           {"law = \"linear\"", "tissue.law = \"linear\": expected \"neo-hookean\""},
           {"law = \"ogden\"", "tissue.law = \"ogden\": expected \"neo-hookean\""},
           {"mooney_c01 = -0.2", "tissue.mooney_c01 = -0.2: expected a number from 0 to 100"},
           {"poisson = 0.5", "tissue.poisson = 0.5: expected a number from -0.99 to 0.4999"},
           {"young_kpa = 0.0001", "tissue.young_kpa = 0.0001: expected a number from 0.001"},
           {"maxwell = \"two\"", "tissue.maxwell = \"two\": expected [[tissue.maxwell]] tables"},
           {"maxwell = [{ ratio = -1, relaxation_s = 1 }]", "tissue.maxwell[0].ratio = -1"},
           {"maxwell = [{ ratio = inf, relaxation_s = 1 }]", "tissue.maxwell[0].ratio = inf"},
           {"maxwell = [{ ratio = 1, relaxation_s = 0 }]", "tissue.maxwell[0].relaxation_s = 0"},
           {"maxwell = [{ ratio = 1 }]", "tissue.maxwell[0].relaxation_s: expected a number"},
           {"[solver]\nfinite_step_s = 3",
            "solver.finite_step_s = 3: expected a number 0, or 0.0001 to 0.5 (s)"},
           {"[solver]\nfinite_step_s = -0.1", "solver.finite_step_s = -0.1: expected a number"},
           {"[solver]\nfinite_tolerance = 0", "solver.finite_tolerance = 0: expected a number"},
           {"[[variant]]\nname = \"x\"\ntissue.viscous_form = \"printed\"",
            "scene.toml:9: variant[0].tissue.viscous_form = \"printed\": expected \"isotropic\""}})
    EXPECT_THAT(of(std::string(more) + "\n"), HasSubstr(problem)) << more;
}

}  // namespace
}  // namespace hyperex::scene
