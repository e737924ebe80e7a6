// SPDX-License-Identifier: GPL-3.0-or-later
// A rig of blend shapes is measured while weights play it, and drives the tissue of its own scan.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "apps/malformed.hpp"

namespace hyperex {
namespace {
using testing::HasSubstr;

class RigRoundTrip : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    put(in("weights.csv"), weights());
    put(in("wrong.csv"), weights(5));
    put(in("scene.toml"),
        "scan.file = \"embedded\"\nmotion = { arkit = \"weights.csv\", rig = \"rig.glb\" }\n"
        "mesh = { element_size_mm = 6 }\n");
  }
  /// A smile and an opening jaw; the smile's weight is 1 in the sample `wrong`.
  static std::string weights(int wrong = -1) {
    std::string text = "time_s,mouthSmileLeft,jawOpen\n";
    for (int k = 0; k <= 30; ++k) {
      const double share = (1 - std::cos(2 * std::numbers::pi * k / 30)) / 2;
      text += fmt::format("{},{},{}\n", k / 30.0, k == wrong ? 1 : 0.8 * share, 0.3 * share);
    }
    return text;
  }
  void make_rig() const {
    const Outcome made = call(
        "rig embedded --out rig.glb --set mesh.element_size_mm=8 --set mesh.layers=1 "
        "--set muscles.shape_prior=false");
    ASSERT_EQ(made.status, 0) << made.err;
  }
  /// A cell of a table by its row's first cell and its column's name, NaN where there is none.
  double cell(const std::string& file, const std::string& row, const std::string& column) const {
    std::istringstream lines(read_file(in(file)));
    std::string line;
    std::getline(lines, line);
    const auto cells = [](const std::string& text) {
      std::vector<std::string> out;
      std::istringstream stream(text);
      for (std::string one; std::getline(stream, one, ',');) out.push_back(one);
      return out;
    };
    const auto names = cells(line);
    const auto at = std::find(names.begin(), names.end(), column) - names.begin();
    while (std::getline(lines, line))
      if (const auto found = cells(line); !found.empty() && found[0] == row)
        return std::stod(found.at(std::size_t(at)));
    return std::nan("");
  }
};

TEST_F(RigRoundTrip, TheTissueFollowsTheRigByTheMillimetresThatItMeasures) {
  make_rig();
  const Outcome measured = call("symmetry weights.csv --rig rig.glb --excursions rig.csv");
  ASSERT_EQ(measured.status, 0) << measured.err;
  const Outcome mended = call("symmetry wrong.csv --rig rig.glb --excursions mended.csv");
  ASSERT_EQ(mended.status, 0) << mended.err;
  EXPECT_THAT(mended.err, HasSubstr("wrong.csv:7, mouthSmileLeft at 0.167 s"));
  EXPECT_NEAR(cell("mended.csv", "cheilion", "excursion_L_mm"),
              cell("rig.csv", "cheilion", "excursion_L_mm"), 0.1);
  put(in("lost.csv"), "time_s,eyeBlinkLeft,eyeBlinkRight,mouthSmileRight\n0,0,0,0\n0.1,0,0,1\n");
  const Outcome lost = call("symmetry lost.csv --rig rig.glb");
  EXPECT_THAT(lost.err, HasSubstr("mouthSmileLeft (mouthSmileRight reaches 1)"));
  const Outcome run = call("run scene.toml --out out --no-cache");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("0.0 mm rms apart before the smooth correction"))
      << "the rig lists its landmarks, which are those of its scan";
  for (const char* side : {"R", "L"}) {
    const std::string column = fmt::format("excursion_{}_mm", side);
    const double rig_mm = cell("rig.csv", "cheilion", column);
    EXPECT_NEAR(cell("out/excursions.csv", "cheilion", column), rig_mm, 0.03 * rig_mm + 0.1)
        << side;
  }
  EXPECT_GT(cell("rig.csv", "cheilion", "excursion_L_mm"), 6);
}

TEST_F(RigRoundTrip, CorrectivesAreListedAndPlayed) {
  const Outcome made = call(
      "rig embedded --out rig.glb --correctives --names unreal --set mesh.element_size_mm=8 "
      "--set mesh.layers=1 --set muscles.shape_prior=false");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("52 shapes and 7 correctives of "));
  EXPECT_THAT(made.out, testing::ContainsRegex("JawOpen_MouthClose  +[0-9.]+ mm; lips [0-9.]+ mm "
                                               "in each other without it, [0-9.]+ mm with it"));
  EXPECT_THAT(read_file(in("rig.glb")), HasSubstr("\"MouthFunnel_MouthSmileRight\""));
  const Outcome measured = call("symmetry weights.csv --rig rig.glb");
  EXPECT_EQ(measured.status, 0) << measured.err;
}

TEST_F(RigRoundTrip, RecipesAndFewerVerticesAreWritten) {
  const std::string recipes =
      std::string(HYPEREX_SOURCE_DIR) + "/examples/rig/vrm_expressions.toml";
  const Outcome made = call("rig embedded --out rig.glb --recipes " + recipes +
                            " --vertices 3000 --skin-tone dark --set mesh.element_size_mm=8 "
                            "--set mesh.layers=1 --set muscles.shape_prior=false");
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_THAT(made.out, HasSubstr("69 shapes of "));
  EXPECT_THAT(made.out, testing::ContainsRegex("happy +[1-9][0-9.]+ mm"));
  EXPECT_THAT(made.out,
              testing::ContainsRegex("lookLeft +0.0 mm; eyes turn by 35 degrees; a recipe"));
  EXPECT_THAT(read_file(in("rig.glb")), HasSubstr("\"surprised\""));
  const Outcome few = call("rig embedded --out few.glb --vertices 100");
  EXPECT_NE(few.status, 0);
  EXPECT_THAT(few.err, HasSubstr("--vertices"));
}

TEST_F(RigRoundTrip, EachFaultIsSaidInOneLine) {
  const auto refused = [&](const std::string& arguments, int status, const std::string& part) {
    const Outcome found = call(arguments);
    EXPECT_EQ(found.status, status) << found.err;
    const auto problems = problems_in(found.err);
    ASSERT_EQ(problems.size(), 1u) << found.err;
    EXPECT_THAT(problems[0], HasSubstr(part));
  };
  refused("check scene.toml", 2, "rig.glb");
  refused("symmetry weights.csv --rig none.glb", 2, "none.glb");
  refused("symmetry weights.csv --rig rig.glb --rigid-points a,b,c", 2,
          "--rigid-points = a,b,c: expected none, as the weights of --rig move a face");
  put(in("recipes.toml"), "[happy]\njawOpn = 1\n");
  refused("rig embedded --out other.glb --recipes recipes.toml", 2, "did you mean jawOpen?");
  refused("rig embedded --out other.glb --recipes none.toml", 2, "none.toml");
  put(in("rig.glb"), "no model");
  refused("symmetry weights.csv --rig rig.glb", 2, "rig.glb");
  put(in("points.toml"),
      "scan.file = \"embedded\"\nmotion = { file = \"embedded\", rig = \"rig.glb\" }\n");
  refused("check points.toml", 2, "only weights move a rig");
}

TEST_F(RigRoundTrip, ValuesAreWrittenAsForARun) {
  for (const char* gain : {"'muscles.gain={\"side_R\": 7}'", "'muscles.gain={ side_R = 7 }'"}) {
    put(in("points.toml"), "scan.file = \"embedded\"\nmotion.file = \"embedded\"\n");
    for (const char* command :
         {"rig embedded --out other.glb --set ", "check points.toml --set "}) {
      const Outcome found = call(std::string(command) + gain);
      EXPECT_EQ(found.status, 2) << found.err;
      EXPECT_THAT(found.err, HasSubstr("--set: muscles.gain.side_R = 7: expected a number"))
          << command << gain;
    }
  }
  const Outcome found = call("rig embedded --out other.glb --set tissue.young_kpa=nan");
  EXPECT_EQ(found.status, 2) << found.err;
  EXPECT_THAT(found.err, HasSubstr("--set: tissue.young_kpa = \"nan\": expected a number"));
}

}  // namespace
}  // namespace hyperex
