// SPDX-License-Identifier: GPL-3.0-or-later
// Runs of recordings with fewer or other points than usual.
#include <gmock/gmock.h>

#include "apps/good_inputs.hpp"
#include "apps/program.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/io/text_table.hpp"

namespace hyperex {
namespace {
using testing::AllOf;
using testing::HasSubstr;

class OtherRecordings : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_good_inputs(in(""));
  }
};

TEST_F(OtherRecordings, ACornerThatIsNotRecordedHasNoFigure) {
  write_opening(in(""), 0, 16, [](motion::Motion& m) {
    leave_out(m, {"cheilion_R", face::ibug(48), face::ibug(60)});
  });
  put(in("scene.toml"), read_file(in("scene.toml")) +
                            "[drive]\npoints = \"all\"\n[[variant]]\npreset = "
                            "\"palsy_complete_L\"\n");
  const Outcome checked = call("check scene.toml");
  EXPECT_EQ(checked.status, 0) << checked.err;
  EXPECT_THAT(checked.out, HasSubstr("warning: the right corner of the mouth is not recorded"));
  const Outcome run = call("run scene.toml --out out");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, AllOf(HasSubstr("corners of the mouth: right not recorded, left "),
                             HasSubstr(" mm: a difference of the sides is not known\n"),
                             HasSubstr("corner of the mouth right not recorded; left ")));
  const auto symmetry = summary()["symmetry"];
  EXPECT_TRUE(symmetry["commissure"]["excursion_mm"]["R"].is_null());
  EXPECT_GT(symmetry["commissure"]["excursion_mm"]["L"], 0.01);
  EXPECT_TRUE(symmetry["commissure"]["difference_mm"].is_null());
  EXPECT_TRUE(symmetry["commissure"]["undecided"].is_null());
  EXPECT_THAT(symmetry["verdict"].get<std::string>(), HasSubstr("not known"));
  const auto row = summary()["variants"]["table"][1];
  EXPECT_TRUE(row["commissure_R_mm"].is_null());
  EXPECT_TRUE(row["commissure_L_mm"].is_number());
  const io::TextTable pairs = io::read_text_table(in("out/excursions.csv"));
  std::size_t corners = 0;
  for (const auto& cells : pairs.rows) {
    if (cells[0] != "cheilion") continue;
    ++corners;
    EXPECT_EQ(cells[1], "") << "right";
    EXPECT_NE(cells[2], "") << "left";
  }
  EXPECT_EQ(corners, 1u);
  const io::TextTable curves = io::read_text_table(in("out/symmetry.csv"));
  EXPECT_EQ(curves.rows.back()[1], "") << curves.names[1];
  EXPECT_NE(curves.rows.back()[2], "") << curves.names[2];
  EXPECT_EQ(curves.rows.back()[3], "") << curves.names[3];
  // The run's folder has both sides of the simulated face, and is said to.
  const std::string variant = summary()["variants"]["table"][1]["folder"];
  for (const std::string& file :
       {std::string("out"), "out/" + variant, std::string("out/motion.csv")}) {
    const Outcome simulated = call("symmetry " + file);
    EXPECT_EQ(simulated.status, 0) << simulated.err;
    EXPECT_THAT(simulated.out, HasSubstr("the sides are those of the face that the run in "));
    EXPECT_THAT(simulated.out, HasSubstr("; for recorded sides give the recording itself\n"));
  }
  const Outcome recorded = call("symmetry motion.csv");
  EXPECT_EQ(recorded.status, 0) << recorded.err;
  EXPECT_THAT(recorded.out, testing::Not(HasSubstr("the sides are those")));
}

/// What stands in for the points of S(t) is told in between, which sends all that was printed.
TEST_F(OtherRecordings, ARunsSidesAreToldBehindTheTableAndNotOfACt) {
  std::filesystem::create_directory(in("made"));
  write_opening(in("made"), 0, 16, [](motion::Motion& m) {
    std::vector<std::string> others;
    for (const std::string& name : m.names)
      if (!name.starts_with("ibug68_")) others.push_back(name);
    leave_out(m, others);
  });
  for (const auto& [more, of_a_run] : {std::pair{"", true}, {", \"command\": \"ct\"", false}}) {
    put(in("made/summary.json"), std::string("{\"program\": \"hyperex\"") + more + "}");
    const Outcome told = call("symmetry made/motion.csv --out /dev/stdout");
    EXPECT_EQ(told.status, 0) << told.err;
    EXPECT_THAT(told.err, HasSubstr("stand-in for "));
    EXPECT_THAT(told.out, testing::StartsWith("time_s,xi_"));
    EXPECT_EQ(told.out.find("the sides are those of the face") != std::string::npos, of_a_run);
  }
}

/// A marker between the lips goes half the way of the lower one. Were it driven, it would draw the
/// upper lip into the mouth as a tusk.
TEST_F(OtherRecordings, AMarkerBetweenTheLipsDrawsNoTusk) {
  write_opening(in(""), 0, 16, [](motion::Motion& m) {
    const int between = m.index_of("stomion"), upper = m.index_of(face::ibug(62)),
              lower = m.index_of(face::ibug(66));
    for (Points& at : m.positions) at.row(between) = (at.row(upper) + at.row(lower)) / 2;
  });
  const Outcome run = call(
      "run scene.toml --out out --set 'drive.points=\"all\"' --set drive.by=displacement --set "
      "time.end_s=0.5 --set output.report=false --set output.glb=false --set output.vtu=false");
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(summary()["inverted_tets"], 0);
  EXPECT_GT(summary()["lip_opening_mm"], 3.3) << "2.7 with a tusk";
  EXPECT_EQ(text_of("drive.points_off"), "");
}

}  // namespace
}  // namespace hyperex
