// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include "hyperex/study/plan_cases.hpp"
#include "unit/study/study_files.hpp"

namespace hyperex::study {
namespace {
using testing::ElementsAre;
using testing::Pair;

class ReadStudy : public StudyFiles {
 protected:
  static std::vector<std::string> names(const Study& study) {
    std::vector<std::string> all;
    for (const Case& one : study.cases) all.push_back(one.name);
    return all;
  }
  static std::vector<std::string> texts(const Case& one) {
    std::vector<std::string> all;
    for (const auto& given : one.overrides) all.push_back(given.text);
    return all;
  }
};

TEST_F(ReadStudy, GridHasEveryCombinationInTheOrderOfTheFile) {
  const Study s = study(
      "[grid]\n"
      "tissue.young_kpa = [30, 60.5]\n"
      "support.skull = [\"held\", \"free\", \"sliding\"]\n");
  EXPECT_THAT(names(s), ElementsAre("young_kpa=30 skull=held", "young_kpa=30 skull=free",
                                    "young_kpa=30 skull=sliding", "young_kpa=60.5 skull=held",
                                    "young_kpa=60.5 skull=free", "young_kpa=60.5 skull=sliding"));
  EXPECT_THAT(texts(s.cases[4]), ElementsAre("tissue.young_kpa=60.5", "support.skull=\"free\""));
  EXPECT_THAT(s.cases[4].cells,
              ElementsAre(Pair("tissue.young_kpa", "60.5"), Pair("support.skull", "free")));
  EXPECT_EQ(s.scene, *this / "scene.toml");
  EXPECT_EQ(s.out, *this / "study_out");
}

TEST_F(ReadStudy, NamedAxesBundleKeys) {
  const Study s = study(
      "out = \"results/a\"\n"
      "set = { output.vtu = false }\n"
      "[[grid.subject]]\n"
      "name = \"A\"\n"
      "scan = { file = \"a.ply\", landmarks = \"a.json\" }\n"
      "[[grid.subject]]\n"
      "name = \"B\"\n"
      "\"scan.file\" = \"b.ply\"\n"
      "[grid]\n");
  EXPECT_THAT(names(s), ElementsAre("A", "B"));
  EXPECT_THAT(texts(s.cases[0]),
              ElementsAre("output.vtu=false", "scan.file=\"a.ply\"", "scan.landmarks=\"a.json\""));
  EXPECT_THAT(texts(s.cases[1]), ElementsAre("output.vtu=false", "scan.file=\"b.ply\""));
  EXPECT_THAT(s.cases[1].cells, ElementsAre(Pair("subject", "B"), Pair("scan.file", "b.ply")));
  EXPECT_EQ(s.out, *this / "results/a");
}

TEST_F(ReadStudy, RowsOfACsvAreCasesAndCombineWithTheGrid) {
  write("cases.csv",
        "case,tissue.young_kpa,drive.points\n"
        "soft,30,\n"
        "stiff,300,\"[\"\"ibug68_8\"\", \"\"ibug68_48\"\"]\"\n");
  const Study s =
      study("cases = \"cases.csv\"\n[grid]\nsolver.method = [\"reduced\", \"direct\"]\n");
  EXPECT_THAT(names(s), ElementsAre("soft method=reduced", "soft method=direct",
                                    "stiff method=reduced", "stiff method=direct"));
  EXPECT_THAT(texts(s.cases[0]), ElementsAre("tissue.young_kpa=30", "solver.method=\"reduced\""));
  EXPECT_THAT(texts(s.cases[3]),
              ElementsAre("tissue.young_kpa=300", "drive.points=[\"ibug68_8\", \"ibug68_48\"]",
                          "solver.method=\"direct\""));
  EXPECT_EQ(s.cases[3].overrides[0].origin.line, 3);
  EXPECT_EQ(plan_cases(s).size(), 4u);
}

/// The scene of a case is the one that `hyperex run --set` would read.
TEST_F(ReadStudy, OverridesAreThoseOfTheCommandLine) {
  const Study s = study(
      "[[grid.cheek]]\nname = \"stiff\"\n"
      "tissue.region = [{ name = \"cheek_R\", young_factor = 10 }]\n"
      "time.step_s = 1e-3\n"
      "title = \"a \\\"quoted\\\" title\"\n");
  const scene::Scene in_study = scene::read_scene_with(s.scene, s.cases[0].overrides);
  const scene::Scene by_hand =
      scene::read_scene(s.scene, {"tissue.region=[{ name = \"cheek_R\", young_factor = 10 }]",
                                  "time.step_s=1e-3", "title=a \"quoted\" title"});
  EXPECT_EQ(scene::options_json(in_study), scene::options_json(by_hand));
  EXPECT_EQ(in_study.tissue.regions.size(), 1u);
}

TEST_F(ReadStudy, PathsAreRelativeToTheStudy) {
  write("data/b.csv", "");
  const Study s = study("[grid]\nmotion.file = [\"data/b.csv\"]\n");
  EXPECT_THAT(names(s), ElementsAre("file=b"));
  EXPECT_EQ(scene::read_scene_with(s.scene, s.cases[0].overrides).motion.source.file,
            *this / "data/b.csv");
}

/// Whether each case keeps the lips apart.
std::vector<bool> lips_kept_apart(const Study& study) {
  std::vector<bool> all;
  for (const Case& one : study.cases)
    all.push_back(scene::read_scene_with(study.scene, one.overrides).contact.lips);
  return all;
}

/// Else contact would make a part of what strain seems to make.
TEST_F(ReadStudy, CasesBesideOneOfFiniteStrainHaveItsContact) {
  using Lips = std::vector<bool>;
  const std::string strains = "tissue.strain = [\"linear\", \"finite\"]\n";
  const Study both = study("[grid]\n" + strains);
  EXPECT_EQ(lips_kept_apart(both), (Lips{false, false}));
  EXPECT_EQ(both.cases[0].overrides.back().text, "contact.lips=false");
  EXPECT_THAT(texts(both.cases[1]), ElementsAre("tissue.strain=\"finite\"")) << "as it was";
  EXPECT_EQ(lips_kept_apart(study("[grid]\ntissue.strain = [\"linear\"]\n")), Lips{true});
  EXPECT_EQ(lips_kept_apart(study("[grid]\ntissue.young_kpa = [30, 60]\n")), (Lips{true, true}));
  write("cases.csv", "case,tissue.strain\nas the scene,\nother,finite\n");
  EXPECT_EQ(lips_kept_apart(study("cases = \"cases.csv\"\n")), (Lips{false, false}));
  EXPECT_EQ(lips_kept_apart(study("set = { contact.lips = true }\n[grid]\n" + strains)),
            (Lips{true, true}));
  EXPECT_EQ(lips_kept_apart(study("[grid]\ncontact.lips = [true, false]\n" + strains)),
            (Lips{true, true, false, false}));
  write("scene.toml", read(*this / "scene.toml") + "[contact]\nlips = true\n");
  EXPECT_EQ(lips_kept_apart(study("[grid]\n" + strains)), (Lips{true, true}));
}

struct Fault {
  const char *name, *text, *sentence;
};

class FaultyStudy : public StudyFiles, public testing::WithParamInterface<Fault> {};

/// The line of the scene is put first, so that each faulty text begins in line 2.
TEST_P(FaultyStudy, IsRefusedInOneSentence) {
  write("unknown.csv", "case,tissue.yung_kpa\na,1\n");
  write("twice.csv", "case,tissue.young_kpa\na,1\na,2\n");
  write("range.csv", "tissue.young_kpa\n10\n-3\n");
  write("empty.csv", "tissue.young_kpa\n");
  write("same.csv", "case,tissue.young_kpa\nwrong,-3\na;b,5\na:b,5\n");
  EXPECT_EQ(refusal([&] { plan_cases(study(GetParam().text)); }), GetParam().sentence);
}

INSTANTIATE_TEST_SUITE_P(
    Study, FaultyStudy,
    testing::Values(
        Fault{"UnknownKey", "[grid]\ntissue.yung_kpa = [1, 2]\n",
              "study.toml:3: grid.tissue.yung_kpa: expected a known key (did you mean "
              "tissue.young_kpa?)"},
        Fault{"OutOfRange",
              "[grid]\nsupport.skull = [\"held\", \"free\"]\ntissue.young_kpa = [1, "
              "-3]\n",
              "study.toml:4: tissue.young_kpa = -3: expected a number from 0.001 to 1e+06 (kPa)"},
        Fault{"MissingFile", "[[grid.a]]\nname = \"x\"\nscan.file = \"gone.ply\"\n",
              "study.toml:4: scan.file = \"gone.ply\": expected an existing file (there is none at "
              "\"gone.ply\")"},
        Fault{"NoList", "[grid]\ntissue.young_kpa = 5\n",
              "study.toml:3: grid.tissue.young_kpa = 5: expected a list of one or more values of "
              "tissue.young_kpa"},
        Fault{"NoValues", "[grid]\ntissue.young_kpa = []\n",
              "study.toml:3: grid.tissue.young_kpa = []: expected a list of one or more values of "
              "tissue.young_kpa"},
        Fault{"NoAxes", "[grid]\n",
              "study.toml:2: grid: expected a key with a list of values, or cases = \"FILE.csv\", "
              "required"},
        Fault{"NoName", "[[grid.a]]\ntissue.young_kpa = 5\n",
              "study.toml:2: grid.a[0].name: expected a name of letters, digits, spaces and any of "
              "-_.,;:+=%&'()[], at most 100, a letter or digit among them"},
        Fault{"NameTwice", "[[grid.a]]\nname = \"x\"\n[[grid.a]]\nname = \"x\"\n",
              "study.toml:5: grid.a[1].name = \"x\": expected a name that no other table of the "
              "axis has"},
        Fault{"KeyTwice",
              "[grid]\ntissue.young_kpa = [5]\n[[grid.a]]\nname = \"x\"\n"
              "tissue.young_kpa = 7\n",
              "study.toml:4: grid.a: expected keys that no other axis sets, and tissue.young_kpa "
              "sets tissue.young_kpa"},
        Fault{"Misspelt", "gird = { tissue.young_kpa = [5] }\n[grid]\ntissue.young_kpa = [5]\n",
              "study.toml:2: gird: expected one of title, scene, out, set, grid, cases; did you "
              "mean grid?"},
        Fault{"KeyOutside", "tissue.young_kpa = 5\n[grid]\nsupport.skull = [\"held\"]\n",
              "study.toml:2: tissue: expected one of title, scene, out, set, grid, cases; keys of "
              "the scene belong under [set] or [grid]"},
        Fault{"Torn", "[grid\n",
              "study.toml:2: expected sound TOML (Error while parsing table header: expected ']', "
              "saw '\\n')"},
        Fault{"SetUnknown", "set = { mesh.layer = 3 }\n[grid]\nsupport.skull = [\"held\"]\n",
              "study.toml:2: set.mesh.layer = 3: expected a known key (did you mean "
              "mesh.layers?)"},
        Fault{"CsvMissing", "cases = \"gone.csv\"\n",
              "study.toml:2: cases = \"gone.csv\": expected an existing CSV file"},
        Fault{"CsvUnknown", "cases = \"unknown.csv\"\n",
              "unknown.csv:1: column \"tissue.yung_kpa\": expected a known key (did you mean "
              "tissue.young_kpa?), or \"case\""},
        Fault{"CsvTwice", "cases = \"twice.csv\"\n",
              "twice.csv:3: case = \"a\": expected a name that no other case has"},
        Fault{"CsvRange", "cases = \"range.csv\"\n",
              "range.csv:3: tissue.young_kpa = -3: expected a number from 0.001 to 1e+06 (kPa)"},
        // Folders have plainer names than cases. The faulty case before them counts as a row.
        Fault{"CsvSameFolder", "cases = \"same.csv\"\n",
              "same.csv:2: tissue.young_kpa = -3: expected a number from 0.001 to 1e+06 (kPa)\n"
              "same.csv:4: case = \"a:b\": expected a name that tells it from another case with "
              "the same inputs"},
        Fault{"CsvEmpty", "cases = \"empty.csv\"\n", "empty.csv: expected one or more rows"}),
    [](const auto& fault) { return std::string(fault.param.name); });

TEST_F(ReadStudy, SceneMustExist) {
  const auto of = [&](const std::string& text) {
    const auto file = write("s.toml", text);
    return refusal([&] { read_study(file); });
  };
  EXPECT_EQ(of("scene = \"gone.toml\"\n[grid]\ntissue.young_kpa = [1]\n"),
            "s.toml:1: scene = \"gone.toml\": expected an existing scene file");
  EXPECT_EQ(of("[grid]\ntissue.young_kpa = [1]\n"),
            "s.toml: scene: expected the path of a scene file, required");
  EXPECT_EQ(refusal([&] { read_study(*this / "gone.toml"); }),
            "gone.toml: expected an existing study file");
}

TEST_F(ReadStudy, TooManyCasesAreRefused) {
  std::string values = "1";
  for (int i = 2; i <= 101; ++i) values += ", " + std::to_string(i);
  EXPECT_EQ(
      refusal([&] {
        study("[grid]\ntissue.young_kpa = [" + values + "]\nmesh.layers = [" + values + "]\n");
      }),
      "study.toml:2: grid: expected at most 10000 cases; its axes make 10201");
}

}  // namespace
}  // namespace hyperex::study
