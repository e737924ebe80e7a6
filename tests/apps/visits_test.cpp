// SPDX-License-Identifier: GPL-3.0-or-later
// `hyperex visits` as a user calls it.
#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "apps/malformed.hpp"
#include "hyperex/face/canonical_face.hpp"
#include "hyperex/geometry/transform.hpp"
#include "hyperex/io/text_table.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/read_motion.hpp"

namespace hyperex {
namespace {
namespace fs = std::filesystem;
using testing::HasSubstr;

class Visits : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    motion::Motion opening = motion::embedded_mouth_opening(good_landmarks());
    motion::write_motion_csv(in("before.csv"), opening);
    for (const char* name : {"cheilion_R", "ibug68_48"}) {
      const auto column = Eigen::Index(opening.index_of(name));
      ASSERT_GE(column, 0);
      const Eigen::RowVector3d rest = opening.positions.front().row(column);
      for (Points& at : opening.positions) at.row(column) = rest + 0.5 * (at.row(column) - rest);
    }
    motion::write_motion_csv(in("after.csv"), opening);
    put("jitter_mm = 0\n");
  }
  void put(const std::string& more) const {
    std::ofstream(in("v.toml")) << "patient = \"P-017\"\n[[visit]]\ndate = 2026-03-01\n"
                                   "recording = \"before.csv\"\n"
                                << more
                                << "[[visit]]\ndate = 2026-06-01\nrecording = \"after.csv\"\n"
                                << more;
  }
};

TEST_F(Visits, WriteAPageAndATable) {
  const Outcome outcome = call("visits v.toml --out v.html --table v.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("Right corner of the mouth: "));
  EXPECT_THAT(outcome.out, HasSubstr("no medical device"));
  EXPECT_THAT(read_file(in("v.html")), testing::StartsWith("<!doctype html>"));
  const io::TextTable table = io::read_text_table(in("v.csv"));
  EXPECT_EQ(table.names.front(), "visit");
  EXPECT_GT(table.rows.size(), 20u);
  // Its own earlier output is replaced, and the same figures are written.
  const std::string before = read_file(in("v.csv"));
  EXPECT_EQ(call("visits v.toml --out v.html --table v.csv").status, 0);
  EXPECT_EQ(read_file(in("v.csv")), before);
}

TEST_F(Visits, GoByTheDateAndNotByTheFile) {
  ASSERT_EQ(call("visits v.toml --table sound.csv").status, 0);
  std::ofstream(in("v.toml")) << "[[visit]]\ndate = 2026-06-01\nrecording = \"after.csv\"\n"
                                 "jitter_mm = 0\n[[visit]]\ndate = 2026-03-01\n"
                                 "recording = \"before.csv\"\njitter_mm = 0\n";
  const Outcome exchanged = call("visits v.toml --table exchanged.csv");
  ASSERT_EQ(exchanged.status, 0) << exchanged.err;
  EXPECT_THAT(exchanged.err, HasSubstr("the visits were sorted by date"));
  EXPECT_EQ(read_file(in("exchanged.csv")), read_file(in("sound.csv")));
}

TEST_F(Visits, LeaveOutAWildReadingAndSaySo) {
  ASSERT_EQ(call("visits v.toml --table sound.csv").status, 0);
  motion::Motion wild = motion::read_motion(in("after.csv"));
  wild.positions[wild.positions.size() / 2](wild.index_of("cheilion_L"), 2) += 0.05;
  fs::create_directory(in("Jane"));
  motion::write_motion_csv(in("Jane/after.csv"), wild);
  put("jitter_mm = 0\n");
  std::string scene = read_file(in("v.toml"));
  scene.replace(scene.find("after.csv"), 9, "Jane/after.csv");
  std::ofstream(in("v.toml")) << scene;
  const Outcome outcome = call("visits v.toml --out v.html --table v.csv");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.out + outcome.err, HasSubstr("jumps away and back"));
  const std::string page = read_file(in("v.html"));
  EXPECT_THAT(page, HasSubstr("jumps away and back"));
  EXPECT_EQ(page.find("Jane"), std::string::npos);
  const io::TextTable sound = io::read_text_table(in("sound.csv")),
                      mended = io::read_text_table(in("v.csv"));
  ASSERT_EQ(mended.rows.size(), sound.rows.size());
  const auto value_of = [](const io::TextTable& of, std::size_t row) {
    const auto column = std::ranges::find(of.names, "value") - of.names.begin();
    return std::stod(of.rows[row][std::size_t(column)]);
  };
  const auto unit = std::size_t(std::ranges::find(sound.names, "unit") - sound.names.begin());
  std::size_t lengths = 0;
  for (std::size_t row = 0; row < sound.rows.size(); ++row) {
    ASSERT_EQ(mended.rows[row][1], sound.rows[row][1]);
    if (sound.rows[row][unit] != "mm") continue;
    ++lengths;
    EXPECT_NEAR(value_of(mended, row), value_of(sound, row), 0.2) << sound.rows[row][1];
  }
  EXPECT_GT(lengths, 5u);
}

TEST_F(Visits, WarnOfJitterThatIsNotKnown) {
  put("");
  const Outcome outcome = call("visits v.toml");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("jitter_mm"));
  EXPECT_THAT(outcome.out, HasSubstr("-0.9          not known  no"));
}

TEST_F(Visits, TakeTheHeadOutByTheSamePointsAtEachVisit) {
  motion::Motion opening = motion::embedded_mouth_opening(good_landmarks());
  keep_mouth_and_headband(opening);
  motion::write_motion_csv(in("before.csv"), opening);
  const auto lost = Eigen::Index(opening.index_of("head_2"));
  for (std::size_t k = 0; k < opening.positions.size(); ++k)
    opening.positions[k](lost, 1) += 1e-4 * double(k);
  motion::write_motion_csv(in("after.csv"), opening);
  const Outcome found = call("visits v.toml --table found.csv");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err,
              testing::AllOf(HasSubstr("held by head_1, head_3, head_4, head_5, head_6, which keep "
                                       "still against each other; not used: head_2 (moves by "),
                             HasSubstr("in every recording; rigid_points of the visits changes"),
                             testing::Not(HasSubstr("warning: the head is held")),
                             testing::Not(HasSubstr("head pose is not taken out"))));
  const std::string visits = read_file(in("v.toml"));
  std::ofstream(in("v.toml"))
      << "rigid_points = [\"head_1\", \"head_3\", \"head_4\", \"head_5\", \"head_6\"]\n"
      << visits;
  const Outcome named = call("visits v.toml --table named.csv");
  EXPECT_THAT(named.err, testing::Not(HasSubstr("held by")));
  EXPECT_EQ(read_file(in("found.csv")), read_file(in("named.csv")));
}

TEST_F(Visits, LayTheSkullByLandmarksWhereABandHoldsTheHead) {
  motion::Motion opening = motion::embedded_mouth_opening(good_landmarks());
  add_headband(opening);
  motion::write_motion_csv(in("before.csv"), opening);
  // On another day the band sits 30 degrees askew.
  const Eigen::AngleAxisd askew(0.5, Vec3::UnitX());
  const Points first = opening.positions.front();
  const Eigen::Index band = opening.index_of("head_1");
  for (Points& at : opening.positions) {
    const Eigen::Isometry3d head = fit_rigid(first.bottomRows(6), at.bottomRows(6));
    for (Eigen::Index p = band; p < at.rows(); ++p)
      at.row(p) = (head * (askew * Vec3(first.row(p).transpose()))).transpose();
  }
  motion::write_motion_csv(in("after.csv"), opening);
  const Outcome found = call("visits v.toml --table found.csv");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, HasSubstr("held by head_1, head_2, head_3, head_4, head_5, head_6, "));
  const io::TextTable table = io::read_text_table(in("found.csv"));
  const auto value = std::size_t(std::ranges::find(table.names, "value") - table.names.begin());
  std::map<std::string, std::vector<double>> of_visits;
  for (const auto& row : table.rows)
    if (row[1].starts_with("corner_up") || row[1].starts_with("corner_forward"))
      of_visits[row[1] + row[2]].push_back(std::stod(row[value]));
  ASSERT_EQ(of_visits.size(), 4u);
  for (const auto& [name, values] : of_visits) {
    ASSERT_EQ(values.size(), 2u) << name;
    EXPECT_NEAR(values[0], values[1], 0.01) << name;
  }
}

TEST_F(Visits, MatchPointsByTheirPlaceWhereRecordingsNameThemDifferently) {
  motion::Motion opening = motion::embedded_mouth_opening(good_landmarks());
  keep_mouth_and_headband(opening);
  const auto called = [&](const std::vector<std::string>& heads) {
    motion::Motion renamed = opening;
    for (std::size_t i = 0; i < heads.size(); ++i) {
      const int row = opening.index_of("head_" + std::to_string(i + 1));
      renamed.names[std::size_t(row)] = heads[i];
    }
    return renamed;
  };
  motion::write_motion_csv(in("before.csv"), called({"17", "21", "26", "27", "36", "45"}));
  motion::write_motion_csv(in("after.csv"), called({"ibug68_17", "ibug68_21", "ibug68_26",
                                                    "ibug68_27", "ibug68_36", "exocanthion_L"}));
  const Outcome found = call("visits v.toml --table found.csv");
  ASSERT_EQ(found.status, 0) << found.err;
  EXPECT_THAT(found.err, testing::AllOf(HasSubstr("held by 17, 21, 26, 27, 36, 45, which"),
                                        testing::Not(HasSubstr("head pose is not taken out"))));
  const std::string visits = read_file(in("v.toml"));
  std::ofstream(in("v.toml")) << "rigid_points = [\"17\", \"ibug68_21\", \"26\", \"27\", "
                                 "\"36\", \"ibug68_45\"]\n"
                              << visits;
  const Outcome named = call("visits v.toml --table named.csv");
  ASSERT_EQ(named.status, 0) << named.err;
  EXPECT_EQ(read_file(in("found.csv")), read_file(in("named.csv")));
}

TEST_F(Visits, WarnOfAnotherScaleAndRefuseExchangedSides) {
  motion::Motion after = motion::read_motion(in("after.csv"));
  for (Points& at : after.positions) at *= 0.4;
  motion::write_motion_csv(in("after.csv"), after);
  const Outcome small = call("visits v.toml");
  EXPECT_EQ(small.status, 0) << small.err;
  EXPECT_THAT(small.err,
              testing::AllOf(HasSubstr("after.csv: the face at rest is 0.4 times as large as in "
                                       "before.csv"),
                             HasSubstr("the recording has not the size of a face")));
  EXPECT_THAT(small.out,
              testing::AllOf(HasSubstr("not compared, as the face at rest is 0.4 times as large in "
                                       "after.csv as in before.csv."),
                             testing::Not(HasSubstr("what measurement and repetition"))));
  for (std::string& name : after.names) name = face::mirrored_landmark(name);
  motion::write_motion_csv(in("after.csv"), after);
  const Outcome exchanged = call("visits v.toml");
  EXPECT_EQ(exchanged.status, 2);
  EXPECT_THAT(exchanged.err, HasSubstr("after.csv: left and right are exchanged"));
}

TEST_F(Visits, SayAtWhichVisitARecordingEndsInTheExpression) {
  const Outcome sound = call("visits v.toml");
  EXPECT_THAT(sound.err, testing::Not(HasSubstr("ends in an expression")));
  EXPECT_THAT(sound.out, testing::Not(HasSubstr("oubtful")));
  motion::Motion after = motion::read_motion(in("after.csv"));
  after.time_s.resize(22);
  after.positions.resize(22);
  motion::write_motion_csv(in("after.csv"), after);
  const Outcome outcome = call("visits v.toml --out v.html");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const std::string words = "2026-06-01 (after.csv): the recording ends in an expression";
  EXPECT_THAT(outcome.err, HasSubstr(words));
  EXPECT_THAT(outcome.out, testing::AllOf(HasSubstr("; doubtful, as said below."),
                                          HasSubstr(", doubtful\n"),  // in the table
                                          HasSubstr("\nDoubtful: " + words)));
  EXPECT_THAT(read_file(in("v.html")), HasSubstr(words));
}

TEST_F(Visits, RefuseCornersThatAreExchangedAtOneVisit) {
  motion::Motion after = motion::read_motion(in("after.csv"));
  std::swap(after.names[std::size_t(after.index_of("ibug68_48"))],
            after.names[std::size_t(after.index_of("ibug68_54"))]);
  motion::write_motion_csv(in("after.csv"), after);
  const Outcome outcome = call("visits v.toml");
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.out, "");
  EXPECT_THAT(outcome.err,
              HasSubstr("after.csv: left and right are exchanged in ibug68_48 and ibug68_54"));
}

TEST_F(Visits, RefuseInOneLineAndLeaveNothing) {
  std::ofstream(in("mine.html")) << "<html>mine</html>";
  std::ofstream(in("text.csv")) << "no recording\n";
  std::ofstream(in("bad.toml")) << "[[visit]]\ndate = 2026-03-01\nrecording = \"text.csv\"\n";
  for (const auto& [arguments, words] :
       {std::pair{"visits none.toml", "no such file"}, std::pair{"visits .", "is a folder"},
        std::pair{"visits v.toml --out mine.html", "is there already"},
        std::pair{"visits v.toml --out v.pdf", "expected a name that ends in .html"},
        std::pair{"visits v.toml --table before.csv", "before.csv"},
        std::pair{"visits bad.toml --out v.html", "text.csv"},
        std::pair{"visits before.csv", "sound TOML"}})
    expect_refused(arguments, words);
}

}  // namespace
}  // namespace hyperex
