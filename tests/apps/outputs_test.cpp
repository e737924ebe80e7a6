// SPDX-License-Identifier: GPL-3.0-or-later
// Existing files at the place of outputs belong to the user, unless an earlier run wrote them.
#include <fmt/format.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "apps/malformed.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class Outputs : public GoodInputs {
 protected:
  void add_variant(const std::string& name) const {
    std::ofstream(in("scene.toml"), std::ios::app)
        << "[[variant]]\nname = \"" << name << "\"\ntissue = { young_kpa = 400 }\n";
  }
  void expect_run(const std::string& out) const {
    const Outcome outcome = call("run scene.toml --out " + out);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
  }
};

TEST_F(Outputs, AFailedWriteBesideVariantsIsToldAndLeavesNothing) {
  add_variant("a");
  // The limit is in half-kilobytes: enough for the tables.
  expect_refused("run scene.toml --out out", "cannot be written (File too large)", "ulimit -f 64");
}

TEST_F(Outputs, OfAnEarlierRunAreReplacedOthersRefused) {
  expect_run("out");
  const auto summary = nlohmann::json::parse(read_file(in("out/summary.json")));
  EXPECT_EQ(summary["program"], "hyperex");
  EXPECT_EQ(summary["files"].get<std::vector<std::string>>().size(),
            std::size_t(std::count_if(fs::recursive_directory_iterator(in("out")), {},
                                      [](const auto& entry) { return entry.is_regular_file(); })));
  EXPECT_THAT(read_file(in("out/report.html")), HasSubstr("face.ply, moved by motion.csv"));
  const auto written = names_in(in("out"));
  expect_run("out");
  EXPECT_EQ(names_in(in("out")), written);
  fs::create_directories(in("out/.git"));
  put(in("out/thesis.doc"), "years");
  expect_refused("run scene.toml --out out", "out: holds .git/ and thesis.doc, which no earlier");
  fs::create_directories(in("mine/notes"));
  put(in("mine/summary.json"), "{}");
  expect_refused("run scene.toml --out mine", "holds notes/ and summary.json, which no earlier");
}

TEST_F(Outputs, TheCurrentFolderIsTakenOnlyWhereItHoldsNothingElse) {
  expect_refused("run scene.toml --out .", "holds face.ply, face_landmarks.json, motion.csv and 1");
  fs::create_directory(in("here"));
  EXPECT_EQ(shell("cd here && $HYPEREX run ../scene.toml --out . >/dev/null 2>&1 && "
                  "$HYPEREX run ../scene.toml --out . >/dev/null 2>&1 && test -e report.html"),
            0);
  for (const auto& entry : fs::directory_iterator(in("here")))
    EXPECT_NE(entry.path().filename().string().front(), '.') << entry.path();
}

TEST_F(Outputs, AnInputIsNotReplaced) {
  expect_run("out");
  replace_in(in("scene.toml"), "motion.csv", "out/motion.csv");
  expect_refused("run scene.toml --out out", "out/motion.csv: lies in ");
  for (const char* arguments :
       {"landmarks face.ply --out face.ply", "landmarks face.ply --out l.json --picture face.ply",
        "symmetry motion.csv --keep-head --out ./motion.csv", "symmetry out --out out/motion.csv",
        "mesh face.ply --out face_landmarks.json", "mesh face.ply --out link.ply",
        "compare face.ply out/skin_peak.ply --picture face.ply",
        "compare face.ply out/skin_peak.ply --json --picture out/skin_peak.ply"}) {
    if (!fs::exists(in("link.ply"))) fs::create_symlink("face.ply", in("link.ply"));
    expect_refused(arguments, "is read too");
  }
  const std::string symmetry = "symmetry motion.csv --keep-head --out a.csv ";
  expect_refused(symmetry + "--excursions a.csv", "is named for two outputs");
  fs::create_directory(in("sub"));
  expect_refused(symmetry + "--picture sub/../a.csv", "is named for two outputs");
  put(in("clip.mp4"), "");
  expect_refused("track clip.mp4 --mirrored no --preview clip.mp4", "is read too");
  expect_refused("track clip.mp4 --out m.csv --plots m.pose.csv", "is named for two outputs");
}

TEST_F(Outputs, AFileIsReplacedOnlyByOneOfItsOwnKind) {
  const std::string tissue = "mesh face.ply --element-size-mm 12 --layers 1 --out ";
  const std::string symmetry = "symmetry motion.csv --keep-head ";
  for (const auto& [arguments, end] : std::vector<std::pair<std::string, std::string>>{
           {tissue + "new.toml", ".vtu"},
           {"landmarks face.ply --out new.csv", ".json"},
           {"landmarks face.ply --out new.json --picture new.jpg", ".png"},
           {symmetry + "--out new.txt", ".csv"},
           {symmetry + "--excursions new.png", ".csv"},
           {symmetry + "--picture new.jpg", ".png"},
           {"compare face.ply face.ply --unit mm --picture new.ply", ".png"},
           {"track nowhere --out new.json", ".csv"},
           {"track nowhere --plots new.csv", ".html"},
           {"track nowhere --glb new.csv", ".glb"}})
    expect_refused(arguments, "expected a name that ends in " + end);
  const auto mine = [&](const std::string& name, const std::string& text) {
    put(in(name), text);
    return name;
  };
  const std::string known = "is there already and is not known to be an earlier output";
  for (const std::string& arguments :
       {tissue + mine("m.vtu", "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\">"),
        "landmarks face.ply --out " + mine("m.json", "{\"notes\": []}"),
        "landmarks face.ply --out l.json --picture " + mine("m.png", "\x89PNG of a holiday"),
        symmetry + "--out " + mine("m.csv", "patient,born\n"), symmetry + "--excursions m.csv",
        symmetry + "--out scene.csv --picture m.png",
        "track nowhere --out " + mine("t.csv", "time_s,my_marker_x_mm\n"),
        "track nowhere --out new.csv --glb " + mine("m.glb", "glTF of a friend"),
        "track nowhere --preview " + mine("m.mp4", "ftyp"),
        "track nowhere --livelink " +
            mine("live.csv", "Timecode,BlendShapeCount,EyeBlinkLeft\n16:07:12:05.613,61,0\n")}) {
    expect_refused(arguments, known);
  }
  mine("u.pose.csv", "my,table\n");
  expect_refused("track nowhere --out u.csv", "u.pose.csv: " + known);
  EXPECT_EQ(read_file(in("m.csv")), "patient,born\n");
  // Its own files are replaced, and empty ones.
  mine("s.csv", "");
  for (int k = 0; k < 2; ++k) {
    const Outcome again = call(symmetry + "--out s.csv --excursions e.csv --picture s.png");
    EXPECT_EQ(again.status, 0) << again.err;
    const Outcome meshed = call(tissue + "tissue.vtu");
    EXPECT_EQ(meshed.status, 0) << meshed.err;
  }
}

TEST_F(Outputs, DevicesAndLinksStay) {
  fs::create_symlink("/dev/null", in("null"));
  ASSERT_EQ(::mkfifo(in("pipe").c_str(), 0600), 0);
  fs::create_directories(in("disk"));
  fs::create_symlink("disk/table.csv", in("link.csv"));
  const std::string symmetry = "symmetry motion.csv --keep-head --out ";
  EXPECT_EQ(call(symmetry + "null --excursions null").status, 0);
  EXPECT_TRUE(fs::is_symlink(in("null")));
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(
      shell("{ $HYPEREX " + symmetry + "pipe >/dev/null 2>&1 & cat pipe >read.csv; wait $!; }"), 0);
  EXPECT_TRUE(fs::is_fifo(in("pipe")));
  EXPECT_EQ(call(symmetry + "link.csv").status, 0);
  EXPECT_TRUE(fs::is_symlink(in("link.csv")));
  EXPECT_EQ(read_file(in("disk/table.csv")), read_file(in("read.csv")));
  EXPECT_EQ(shell("$HYPEREX " + symmetry + "/dev/stdout >>said.csv 2>/dev/null"), 0);
  EXPECT_THAT(read_file(in("said.csv")), testing::StartsWith(read_file(in("read.csv"))));

  fs::create_directory(in("large"));
  fs::create_symlink("large", in("out"));
  expect_run("out");
  EXPECT_TRUE(fs::is_symlink(in("out")));
  EXPECT_TRUE(fs::exists(in("large/summary.json")));
}

TEST_F(Outputs, WhatCannotBeIsToldBeforeTheWork) {
  fs::create_symlink("nowhere", in("dangling"));
  expect_refused("run scene.toml --out dangling", "is a link to nowhere, which does not exist");
  expect_refused("run scene.toml --out ''", "the name of the folder for the outputs is empty");
  expect_refused("run scene.toml --out motion.csv", "is a file; expected the name of a folder");
  expect_refused("run scene.toml --out " + std::string(256, 'x'), "File name too long");
  expect_refused("symmetry motion.csv --out .", "is a folder; expected the name of a file");
  fs::create_symlink("circle", in("circle"));
  const Outcome run = call("run scene.toml --out circle");
  EXPECT_EQ(run.status, 2);
  EXPECT_THAT(run.err, HasSubstr("circle: cannot be written ("));
  const Outcome symmetry = call("symmetry motion.csv --out circle");
  EXPECT_EQ(symmetry.status, 2);
  EXPECT_THAT(symmetry.err, HasSubstr("is a link that leads in a circle"));
  const std::string long_name(250, 'x');
  expect_run(long_name);
  EXPECT_TRUE(fs::exists(in(long_name + "/report.html")));
}

TEST_F(Outputs, AFolderWhoseNameIsNoUtf8WillDo) {
  const std::string folder = "caf\351";
  fs::create_directory(in(folder));
  for (const char* name : {"face.ply", "face_landmarks.json", "motion.csv", "scene.toml"})
    fs::copy_file(in(name), in(folder) / name);
  const Outcome outcome = call("run '" + folder + "/scene.toml' --out '" + folder + "/out'");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NO_THROW(nlohmann::json::parse(read_file(in(folder) / "out/summary.json")));
  expect_refused("run scene.toml --out '" + folder + "'", "no earlier run is known");
}

TEST_F(Outputs, ARunSaysThatItReplacesAnEarlierOne) {
  add_variant("stiff");
  const std::string said =
      "info: replacing the results of an earlier run in out once this run ends";
  EXPECT_THAT(call("run scene.toml --out out").err, testing::Not(HasSubstr("replacing")));
  EXPECT_THAT(call("run scene.toml --out out").err, HasSubstr(said + "\n"));
  EXPECT_THAT(call("run scene.toml --out out --no-variants").err,
              HasSubstr(said + ", those of its variants too\n"));
  EXPECT_FALSE(fs::exists(in("out/variants")));
}

TEST_F(Outputs, WithoutItsFiniteVariantARunKeepsTheLipsApart) {
  std::ofstream(in("scene.toml"), std::ios::app)
      << "[[variant]]\nname = \"finite\"\ntissue.strain = \"finite\"\n";
  const Outcome run = call("run scene.toml --out out --no-variants");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(summary()["options"]["contact"]["lips"], true);
}

TEST_F(Outputs, AVariantsNameMayHoldAComma) {
  add_variant("stiff, both (x2)");
  expect_run("out");
  EXPECT_TRUE(fs::exists(in("out/variants/stiff_both_x2/skin_peak.ply")));
  EXPECT_THAT(read_file(in("out/variants.csv")), HasSubstr("\n\"stiff, both (x2)\","));
  const auto summary = nlohmann::json::parse(read_file(in("out/summary.json")));
  EXPECT_EQ(summary["variants"]["table"][1]["folder"], "variants/stiff_both_x2");
}

TEST_F(Outputs, WhatIsWrongIsSaidInWordsOfTheUsers) {
  put(in("live.csv"), "Timecode,BlendShapeCount,EyeBlinkLeft\n16:07:12:05.613,61,0\n");
  expect_refused("check scene.toml --set motion.file=live.csv", "expected it as motion.arkit");
  expect_refused("check scene.toml --set motion.recording=nowhere",
                 "expected an existing folder or video");
  put(in("torn.toml"), "scan.file = \"embedded\"\nmotion.file = \"motion.csv\nmesh.layers = 1\n");
  expect_refused("check torn.toml", "torn.toml:2: expected sound TOML (a string that does not end");
  expect_refused("check scene.toml --set", "KEY=VALUE");
  expect_refused("symmetry nowhere.csv", "nowhere.csv: no such file");
  expect_refused("symmetry nowhere", "nowhere: no such file");
  expect_refused("track motion.csv --mirrored maybe --out m.csv", "expected yes or no");
  expect_refused("track", "hyperex: track: nothing to do");
  const Outcome gone = call("track nowhere.mp4 --out m.csv");
  EXPECT_THAT(gone.err, testing::Not(HasSubstr("not mirrored")));
  const Outcome alone = call("");
  EXPECT_EQ(alone.status, 2);
  EXPECT_THAT(alone.err, HasSubstr("hyperex new SCAN MOTION"));
  add_variant("base");
  expect_refused("check scene.toml", "\"base\": expected another name");
}

TEST_F(Outputs, WhatIsNoCommandOrSceneIsToldAsSuch) {
  expect_refused("animate scene.toml",
                 "\"animate\": expected a subcommand (new, sample, run, check, ");
  expect_refused("simmetry motion.csv", "did you mean symmetry?");
  expect_refused("run face.ply --out out",
                 "this is a scan. hyperex new face.ply MOTION writes one");
  // Problems of the scene are reported before the missing name of the output folder.
  expect_refused("run face.ply", "this is a scan. hyperex new face.ply MOTION writes one");
  expect_refused("run sceen.toml", "sceen.toml: expected an existing scene file");
  expect_refused("run scene.toml", "--out is required");
}

TEST_F(Outputs, WhatACommandDoesNotExpectIsNamedInTheOrderGiven) {
  for (const char* sets : {"scene.toml --set time.start_s=1 --set time.end_s=2", "--set a=1"})
    expect_refused(fmt::format("studio --no-browser {}", sets),
                   "hyperex: studio has no --set: put the key into the scene file");
  for (const char* sets :
       {"scene.toml --set tissue.young_kpa 300", "--set tissue.young_kpa 300 scene.toml"})
    expect_refused(fmt::format("run {} --out out", sets),
                   "hyperex: --set expects KEY=VALUE: 'tissue.young_kpa' has no '='");
  expect_refused("rig face.ply --out rig.glb --no-cache",
                 "rig has no --no-cache: it neither keeps nor uses results of earlier runs");
  expect_refused("run scene.toml --out out --no-variant", "(did you mean --no-variants?)");
  expect_refused("run scene.toml --out out --colour=red",
                 "run has no --colour; hyperex run --help lists its options");
  expect_refused("run scene.toml b.toml c.toml --out out",
                 "run does not expect this: b.toml c.toml");
  EXPECT_THAT(
      problems_in(call("run scene.toml --out out --loud 3 --colour red").err),
      testing::ElementsAre(HasSubstr("run has no --loud"), HasSubstr("run has no --colour")));
}

}  // namespace
}  // namespace hyperex
