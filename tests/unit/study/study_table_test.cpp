// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/study_table.hpp"

#include <gmock/gmock.h>

#include "hyperex/io/text_table.hpp"
#include "hyperex/study/study_folder.hpp"
#include "unit/study/study_files.hpp"

namespace hyperex::study {
namespace {
using testing::ElementsAre;
using testing::Pair;

const char* const kSummary = R"({
  "program": "hyperex", "title": "x", "nodes": 10, "max_displacement_mm": 25.5,
  "at_peak": {"stress_kpa": {"median": 8.5}},
  "symmetry": {"S_most": null, "verdict": "undecided",
    "commissure": {"point": "cheilion", "excursion_mm": {"L": 3.8, "R": 12.7}, "undecided": false},
    "excursions": [{"point": "cheek", "excursion_mm": {"L": 1.5, "R": 2.5}, "path_mm": {"L": 3},
                    "undecided": true}]},
  "variants": {"table": [{"name": "stiff", "lag_ms": 4.5}]},
  "seconds": {"total": 1.25},
  "options": {"tissue": {"young_kpa": 30}}, "files": ["a"], "warnings": ["one", "two"]})";

TEST(Measures, AreTheNumbersOfASummaryUnderTheirPlaces) {
  EXPECT_THAT(measures_in(nlohmann::ordered_json::parse(kSummary)),
              ElementsAre(Pair("symmetry.commissure.excursion_mm.L", "3.8"),
                          Pair("symmetry.commissure.excursion_mm.R", "12.7"),
                          Pair("symmetry.commissure.undecided", "0"), Pair("symmetry.S_most", ""),
                          Pair("max_displacement_mm", "25.5"), Pair("seconds.total", "1.25"),
                          Pair("nodes", "10"), Pair("at_peak.stress_kpa.median", "8.5"),
                          Pair("symmetry.excursions.cheek.excursion_mm.L", "1.5"),
                          Pair("symmetry.excursions.cheek.excursion_mm.R", "2.5"),
                          Pair("symmetry.excursions.cheek.undecided", "1"),
                          Pair("variants.stiff.lag_ms", "4.5"), Pair("warnings", "2")));
}

class StudyTable : public StudyFiles {};

TEST_F(StudyTable, HasARowACaseWhateverItsState) {
  const Study s = study(
      "[grid]\ntissue.young_kpa = [30, 60]\n"
      "[[grid.cheek]]\nname = \"soft\"\n[[grid.cheek]]\nname = \"stiff, right\"\n"
      "tissue.viscosity_pa_s = 5\n");
  make_study_folder(s.out);
  const auto planned = plan_cases(s);
  ASSERT_EQ(planned.size(), 4u);
  const auto below = [&](const std::filesystem::path& path) {
    return path.lexically_relative(folder()).string();
  };
  write(below(planned[1].files.folder / "summary.json"), kSummary);
  write(below(planned[2].files.log), "$ x\nhyperex: no\nhyperex sweep: failed, exit status 1\n");
  EXPECT_THAT(write_table(s, planned),
              ElementsAre(State::not_run, State::finished, State::failed, State::not_run));
  EXPECT_TRUE(read(table_of(s.out)).starts_with(kTableBegins));
  const io::TextTable table = io::read_text_table(table_of(s.out));
  const auto cell = [&](std::size_t row, const std::string& name) {
    const auto at = std::find(table.names.begin(), table.names.end(), name);
    return at == table.names.end() ? "no column"
                                   : table.rows[row][std::size_t(at - table.names.begin())];
  };
  ASSERT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(cell(0, "case"), "young_kpa=30 soft");
  EXPECT_EQ(cell(3, "case"), "young_kpa=60 stiff, right");
  EXPECT_EQ(cell(3, "cheek"), "stiff, right");
  EXPECT_EQ(cell(3, "tissue.viscosity_pa_s"), "5");
  EXPECT_EQ(cell(2, "tissue.viscosity_pa_s"), "");
  EXPECT_EQ(cell(1, "state"), "finished");
  EXPECT_EQ(cell(1, "symmetry.commissure.excursion_mm.R"), "12.7");
  EXPECT_EQ(cell(0, "symmetry.commissure.excursion_mm.R"), "");
  EXPECT_EQ(cell(2, "message"), "no");
  EXPECT_EQ(cell(1, "message"), "");
  EXPECT_EQ(cell(2, "hash"), planned[2].hash);
  EXPECT_EQ(cell(2, "folder"), "cases/" + planned[2].files.folder.filename().string());
  // What cases change stands before what is measured.
  EXPECT_THAT(std::vector<std::string>(table.names.begin(), table.names.begin() + 6),
              ElementsAre("case", "state", "tissue.young_kpa", "cheek", "tissue.viscosity_pa_s",
                          "symmetry.commissure.excursion_mm.L"));
}

}  // namespace
}  // namespace hyperex::study
