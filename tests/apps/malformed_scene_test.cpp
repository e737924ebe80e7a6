// SPDX-License-Identifier: GPL-3.0-or-later
// Faulty scenes and options, unusable output folders and a full disk; several problems at once.
#include "apps/malformed.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/face_session.hpp"
#include "support/note_matchers.hpp"

namespace hyperex {
namespace {

namespace fs = std::filesystem;
using test::has_id;
using test::is_note;
using test::is_warning;
using test::says;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class MalformedScene : public Malformed {};
TEST_P(MalformedScene, IsRefusedInOneLine) {
  expect_refused(GetParam());
}

Fault key(const std::string& name, const std::string& setting, std::vector<std::string> reported) {
  return {name, [](const In&) {}, std::move(reported),
          "run scene.toml --out out --set '" + setting + "'"};
}

void line_in_scene(const In& in, const std::string& line) {
  put(in("scene.toml"), read_file(in("scene.toml")) + line + "\n");
}

const std::vector<Fault> kScenes{
    key("NegativeStiffness", "tissue.young_kpa=-5",
        {"tissue.young_kpa", "-5", "from 0.001", "kPa"}),
    key("Incompressible", "tissue.poisson=0.5", {"tissue.poisson", "0.5", "0.4999"}),
    key("NoStep", "time.step_s=0", {"time.step_s", "= 0", "1e-06"}),
    key("MillionsOfSteps", "time.step_s=1e-6' --set 'time.end_s=600",
        {"time.step_s", "1e-06", "at least", "steps"}),
    key("NotANumber", "tissue.density_kg_m3=nan", {"tissue.density_kg_m3", "nan"}),
    key("EndBeforeTheFirstStep", "time.end_s=0.001", {"time.end_s", "0.001", "step"}),
    key("UnknownChoice", "support.skull=glued", {"support.skull", "glued", "held", "free"}),
    key("WrongType", "mesh.layers=two", {"mesh.layers", "two", "integer"}),
    key("UnknownKey", "tissue.youngs_kpa=5", {"tissue.youngs_kpa", "young_kpa"}),
    key("SettingWithoutValue", "tissue.young_kpa", {"tissue.young_kpa", "KEY=VALUE"}),
    key("MissingScan", "scan.file=nobody.ply", {"scan.file", "nobody.ply", "exist"}),
    key("NoSuchLandmark", "drive.still_points=[\"antenna\"]", {"drive.still_points", "antenna"}),
    key("StillPointThatIsDriven", "drive.still_points=[\"ibug68_57\"]",
        {"drive.still_points", "ibug68_57", "not driven"}),
    key("TimeStandsStill", "motion.time_scale=0", {"motion.time_scale", "0.05", "20"}),
    {"GainOnNoPoint",
     [](const In& in) {
       line_in_scene(in, "[[motion.point_gain]]\npoint = \"antenna\"\ngain = 2");
     },
     {"scene.toml:17", "motion.point_gain[0].point", "antenna", "recording"}},
    {"GainTwice",
     [](const In& in) {
       for (int i = 0; i < 2; ++i)
         line_in_scene(in, "[[motion.point_gain]]\npoint = \"ibug68_48\"\ngain = 2");
     },
     {"scene.toml:20", "motion.point_gain[1].point", "ibug68_48", "once"}},
    key("NegativeStiffnessAtAPoint", "tissue.point=[{landmark=\"cheek\", young_kpa=-3}]",
        {"tissue.point[0].young_kpa", "-3", "from 0.001"}),
    key("NegativeViscosityInARegion", "tissue.region=[{name=\"nose\", viscosity_pa_s=-1}]",
        {"tissue.region[0].viscosity_pa_s", "-1", "from 0"}),
    key("NegativeFactor", "tissue.region=[{name=\"nose\", young_factor=-1}]",
        {"tissue.region[0].young_factor", "-1", "above 0"}),
    key("IndefiniteAfterAFactor", "tissue.region=[{name=\"nose\", poisson_factor=1.02}]",
        {"tissue.region[0].poisson_factor", "1.02", "from -0.99 to 0.4999", "0.5049"}),
    key("NegativeThicknessOfALayer", "tissue.layer=[{thickness_mm=-2, young_factor=2}]",
        {"tissue.layer[0].thickness_mm", "-2", "above 0 to 40"}),
    key("PointOnTheOtherSide", "tissue.point=[{landmark=\"cheek_R\", side=\"L\", young_kpa=3}]",
        {"tissue.point[0].side", "L", "cheek_R lies on the subject's right"}),
    key("NoSuchRegion", "tissue.region=[{name=\"cheeks_R\", young_factor=2}]",
        {"tissue.region[0].name", "cheeks_R", "hyperex presets"}),
    key("EmptyRegion", "tissue.region=[{scar_points_mm=[[0,0,900],[0,9,900]], young_factor=2}]",
        {"tissue.region[0].scar_points_mm", "within 15 mm of the scan"}),
    key("NoSuchPreset", "tissue.preset=granite", {"tissue.preset", "granite", "hyperex presets"}),
    {"KeyWithALine",
     [](const In& in) { line_in_scene(in, "colour = 1"); },
     {"scene.toml:16", "output.colour"}},
    {"KeyBeyondAscii",
     [](const In& in) { line_in_scene(in, "gr\u00f6\u00dfe = 1"); },
     {"scene.toml:16", "needs quotes"}},
    {"TornToml", [](const In& in) { line_in_scene(in, "[tissue"); }, {"scene.toml:16", "TOML"}},
    {"KeyTwice",
     [](const In& in) { line_in_scene(in, "[time]\nstep_s = 1"); },
     {"scene.toml:16", "TOML"}},
    {"MissingScene", [](const In&) {}, {"none.toml", "expected"}, "run none.toml --out out"},
    {"NoMotion",
     [](const In& in) { replace_in(in("scene.toml"), "[motion]\nfile = \"motion.csv\"\n", ""); },
     {"scene.toml", "motion.file"}},
    {"NoOut", [](const In&) {}, {"--out"}, "run scene.toml"},
    {"OutIsAFile", [](const In& in) { put(in("out"), "letters"); }, {"out", "is a file"}},
    {"OutHoldsOtherFiles",
     [](const In& in) {
       fs::create_directory(in("out"));
       put(in("out/letter.txt"), "dear");
     },
     {"out", "holds letter.txt, which no earlier run"}},
    {"OutBelowAFile",
     [](const In&) {},
     {"face.ply/out", "cannot be created"},
     "run scene.toml --out face.ply/out"},
    {"FullDisk",
     [](const In&) {},
     {"/out/", "cannot be written", "too large"},
     "run scene.toml --out out",
     "ulimit -f 40"},
    {"FullDiskForOneMesh",
     [](const In&) {},
     {"out.vtu", "cannot be written", "too large"},
     "mesh face.ply --unit mm --out out.vtu",
     "ulimit -f 40"},
    key("FarTooCoarse", "mesh.element_size_mm=30",
        {"mesh.element_size_mm", "= 30", "at most 1", "mouth"}),
};

INSTANTIATE_TEST_SUITE_P(Scene, MalformedScene, testing::ValuesIn(kScenes), name_of_fault);

// ---- the ground and several at once
// --------------------------------------------------------------

TEST_F(GoodInputs, RunWithoutFault) {
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("no problems found"));
  const Outcome run = call("run scene.toml --out out");
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("report.html"));
  EXPECT_TRUE(fs::exists(in("out/report.html")));
}

TEST_F(GoodInputs, NotesWhatMayBeAMistake) {
  /// The notes of a scene, all of which the program prints.
  const auto checked = [this](std::vector<std::string> changes) {
    const auto notes = session::check(scene::read_scene(in("scene.toml"), changes));
    std::string command = "check scene.toml";
    for (const std::string& change : changes) command += " --set '" + change + "'";
    const std::string printed = call(command).out;
    for (const Note& note : notes) EXPECT_THAT(printed, HasSubstr(note.text));
    return notes;
  };
  io::Landmarks marks = good_landmarks();
  marks["cheilion_r"] = marks["mole"] = marks["cheilion_R"];
  io::write_landmarks(in("face_landmarks.json"), marks, io::LengthUnit::millimetre);
  const std::vector<Note> sound = checked({});
  EXPECT_THAT(sound, Contains(AllOf(is_note("landmarks.unknown"), says("mole"))));
  EXPECT_THAT(sound, Contains(AllOf(is_warning("landmarks.misspelt"), says("cheilion_R"))));
  EXPECT_THAT(sound, Not(Contains(has_id("support.none"))));
  // A landmark that the scene names is not ignored.
  const std::vector<Note> named = checked({R"(drive.still_points=["mole"])", "scan.unit=guess"});
  EXPECT_THAT(named, Not(Contains(says("mole"))));
  EXPECT_THAT(named, Contains(AllOf(is_note("scan.unit_guessed"), says("mm"))));
  EXPECT_THAT(checked({"support.border=free", "support.skull=free", "support.mandible=free",
                       "support.field_kpa_per_mm=0"}),
              Contains(is_note("support.none")));
  const Outcome mesh = call("mesh face.ply --out out.vtu --element-size-mm 12 --layers 1");
  EXPECT_EQ(mesh.status, 0) << mesh.err;
  EXPECT_THAT(mesh.err, AllOf(HasSubstr("face.ply: unit mm, guessed by its size"),
                              HasSubstr("cheilion_r, mole")));
}

TEST_F(GoodInputs, CheckTellsAllProblemsOfASceneAtOnce) {
  const Outcome found = call(
      "check scene.toml --set tissue.young_kpa=-1 --set time.step_s=0 --set mesh.colour=red "
      "--set scan.file=none.ply");
  EXPECT_EQ(found.status, 2);
  EXPECT_EQ(problems_in(found.err).size(), 4u) << found.err;
  for (const char* reported : {"tissue.young_kpa", "time.step_s", "mesh.colour", "none.ply"})
    EXPECT_THAT(found.err, HasSubstr(reported));
}

TEST_F(GoodInputs, CheckTellsTheProblemsOfAllFilesAtOnce) {
  tear(in("face.ply"), 0.5);
  put(in("face_landmarks.json"), "{");
  put(in("motion.csv"), "");
  const Outcome found = call("check scene.toml");
  EXPECT_EQ(found.status, 2);
  EXPECT_EQ(problems_in(found.err).size(), 3u) << found.err;
  for (const char* reported : {"face.ply", "face_landmarks.json", "motion.csv"})
    EXPECT_THAT(found.err, HasSubstr(reported));
}

TEST_F(GoodInputs, AFailedRunLeavesTheEarlierOne) {
  ASSERT_EQ(call("run scene.toml --out out --set output.vtu=false").status, 0);
  const auto before = names_in(in(""));
  const std::string summary = read_file(in("out/summary.json"));
  EXPECT_EQ(call("run scene.toml --out out", "ulimit -f 40").status, 2);
  EXPECT_EQ(names_in(in("")), before);
  EXPECT_EQ(read_file(in("out/summary.json")), summary);
}

}  // namespace
}  // namespace hyperex
