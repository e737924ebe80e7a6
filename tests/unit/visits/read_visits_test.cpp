// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/read_visits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "support/refusal.hpp"
#include "support/test_file.hpp"

namespace hyperex::visits {
namespace {
using testing::ElementsAre;
using testing::HasSubstr;

class ReadVisits : public testing::Test {
 protected:
  void SetUp() override {
    for (const char* name : {"a.csv", "b.csv", "c.csv"}) std::ofstream(folder_ / name) << "x";
  }
  std::filesystem::path put(const std::string& text) const {
    std::ofstream(folder_ / "v.toml") << text;
    return folder_ / "v.toml";
  }
  std::string refused(const std::string& text) const {
    return test::refusal([&] { read_visits(put(text)); });
  }
  const TestFolder folder_;
};

TEST_F(ReadVisits, HasEveryKey) {
  const VisitsFile file = read_visits(
      put("patient = \"P-017\"\nexpression = \"pucker\"\nrepetition_mm = 2\nunit = \"cm\"\n"
          "rigid_points = [\"nasion\"]\n[[visit]]\ndate = 2026-03-01\nrecording = \"a.csv\"\n"
          "note = \"before\"\njitter_mm = 0.2\nend_s = 1.5\nrest_scan = \"a.csv\"\n"
          "peak_scan = \"a.csv\"\npeak_landmarks = \"a.csv\"\n[[visit]]\ndate = \"later\"\n"
          "recordings = [\"b.csv\", \"c.csv\"]\n"));
  EXPECT_EQ(file.patient, "P-017");
  EXPECT_EQ(file.expression.name, "pucker");
  EXPECT_DOUBLE_EQ(file.repetition_m.value(), 2e-3);
  EXPECT_EQ(file.unit, io::length_unit("cm"));
  EXPECT_THAT(file.rigid_points, ElementsAre("nasion"));
  ASSERT_EQ(file.visits.size(), 2u);
  EXPECT_EQ(file.visits[0].label, "2026-03-01");
  EXPECT_EQ(file.visits[0].note, "before");
  EXPECT_DOUBLE_EQ(file.visits[0].jitter_m.value(), 2e-4);
  EXPECT_EQ(file.visits[0].end_s, 1.5);
  ASSERT_TRUE(file.visits[0].rest_scan && file.visits[0].peak_scan);
  EXPECT_EQ(file.visits[0].rest_scan->file.filename(), "a.csv");
  EXPECT_TRUE(file.visits[0].rest_scan->landmarks.empty());
  EXPECT_EQ(file.visits[0].peak_scan->landmarks.filename(), "a.csv");
  EXPECT_FALSE(file.visits[1].rest_scan);
  EXPECT_EQ(file.visits[1].label, "later");
  EXPECT_EQ(file.visits[1].recordings.size(), 2u);
  EXPECT_EQ(
      read_visits(put("[[visit]]\ndate = 2026-03-01\nrecording = \"a.csv\"\n")).expression.name,
      "smile");
}

TEST_F(ReadVisits, SortsVisitsByDateAndSaysSo) {
  const auto visits = [&](const std::string& first, const std::string& second) {
    return read_visits(put("[[visit]]\ndate = " + first +
                           "\nrecording = \"a.csv\"\nnote = \"a\"\n" +
                           "[[visit]]\ndate = " + second + "\nrecording = \"b.csv\"\n"));
  };
  const VisitsFile exchanged = visits("2026-06-01", "2026-03-01");
  EXPECT_EQ(exchanged.visits[0].label, "2026-03-01");
  EXPECT_EQ(exchanged.visits[0].recordings[0].filename(), "b.csv");
  EXPECT_EQ(exchanged.visits[1].note, "a");
  EXPECT_THAT(exchanged.order_remark, HasSubstr("sorted by date"));
  EXPECT_THAT(exchanged.order_remark, HasSubstr("the first is 2026-03-01"));
  const VisitsFile rising = visits("2026-03-01", "2026-06-01");
  EXPECT_EQ(rising.visits[0].note, "a");
  EXPECT_EQ(rising.order_remark, "");
  const VisitsFile one_day = visits("2026-03-01T15:00:00", "2026-03-01T09:30:00");
  EXPECT_EQ(one_day.visits[1].note, "a");
  // A name in quotes may begin with a date; on one day the order of the file stays.
  EXPECT_EQ(visits("\"2026-06-01, after\"", "2026-03-01").visits[1].note, "a");
  EXPECT_EQ(visits("\"2026-06-01, b\"", "\"2026-06-01, a\"").visits[0].note, "a");
  for (const char* name : {"\"before\"", "\"01.03.2026\"", "\"2026-13-01\""}) {
    const VisitsFile named = visits(name, "2026-01-01");
    EXPECT_EQ(named.visits[0].note, "a") << name;
    EXPECT_THAT(named.order_remark, HasSubstr("in the order of the file")) << name;
    EXPECT_THAT(named.order_remark, HasSubstr("is no date such as 2026-03-01")) << name;
  }
  EXPECT_EQ(read_visits(put("[[visit]]\ndate = \"x\"\nrecording = \"a.csv\"\n")).order_remark, "");
}

TEST_F(ReadVisits, NamesWhatIsWrongAndWhere) {
  const std::string visit = "[[visit]]\ndate = 2026-03-01\nrecording = \"a.csv\"\n";
  EXPECT_THAT(refused("patient = 3\n" + visit), HasSubstr("v.toml:1: patient = 3"));
  EXPECT_THAT(refused("expresion = \"smile\"\n" + visit), HasSubstr("did you mean expression"));
  EXPECT_THAT(refused("expression = \"grin\"\n" + visit), HasSubstr("\"eye closure\""));
  EXPECT_THAT(refused("repetition_mm = -1\n" + visit), HasSubstr("from 0 to 20 (mm)"));
  EXPECT_THAT(refused("unit = \"inch\"\n" + visit), HasSubstr("\"mm\", \"cm\" or \"m\""));
  EXPECT_THAT(refused("patient = \"x\"\n"), HasSubstr("[[visit]]"));
  EXPECT_THAT(refused("[[visit]]\nrecording = \"a.csv\"\n"), HasSubstr("2026-03-01"));
  EXPECT_THAT(refused("[[visit]]\ndate = \"x\"\nrecording = \"none.csv\"\n"),
              HasSubstr("visit[0].recording = \"none.csv\": expected an existing file"));
  EXPECT_THAT(refused("[[visit]]\ndate = \"x\"\n"), HasSubstr("either recording"));
  EXPECT_THAT(refused(visit + "end_s = 0\n"), HasSubstr("a number above 0 (s)"));
  EXPECT_THAT(refused(visit + "rest_scan = \"none.ply\"\n"), HasSubstr("an existing scan"));
  EXPECT_THAT(refused(visit + "rest_landmarks = \"a.csv\"\n"),
              HasSubstr("rest_scan beside it, the scan that they are of"));
  EXPECT_THAT(refused(visit + visit), HasSubstr("a date that no other visit has"));
  EXPECT_THAT(refused("[[visit]]\ndate = \"x\"\nrecordings = [\"a.csv\", \"./a.csv\"]\n"),
              HasSubstr("a recording that is not given before"));
  EXPECT_THAT(refused("patient = \n"), HasSubstr("sound TOML"));
}

}  // namespace
}  // namespace hyperex::visits
