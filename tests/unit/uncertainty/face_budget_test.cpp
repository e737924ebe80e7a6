// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/uncertainty/face_budget.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hyperex/core/files.hpp"
#include "hyperex/scene/scene.hpp"
#include "hyperex/session/variants.hpp"
#include "hyperex/uncertainty/budget_outputs.hpp"
#include "support/test_file.hpp"

namespace hyperex::uncertainty {
namespace {

using metrics::ErrorPart;

/// A mouth opening on a coarse mesh, and the same with a stiff right cheek and with a weak branch.
class CoarseFace {
 public:
  CoarseFace()
      : session_(scene::read_scene_text(
            "scan.file = \"embedded\"\nmotion.file = \"embedded\"\nmesh.element_size_mm = 6\n"
            "drive.by = \"muscles\"\ntime.step_s = 0.05\noutput.jitter_mm = 0.1\n"
            "[[variant]]\nname = \"stiff, right\"\n"
            "[[variant.tissue.region]]\nname = \"cheek_R\"\nyoung_factor = 5\n"
            "[[variant]]\nname = \"weak, right\"\nmuscles.gain = { mandibular_R = 0.5 }",
            "made_up.toml")) {
    session_.run();
    session_.find_certainty();
    budget_ = face_budget(session_);
  }
  const session::FaceSession& session() const { return session_; }
  const FaceBudget& budget() const { return budget_; }

  const BudgetedFigure& figure(FigureKind kind, const std::string& point, char side,
                               const std::string& variant = "stiff, right") const {
    return *std::ranges::find_if(budget_.figures, [&](const BudgetedFigure& figure) {
      return figure.kind == kind && figure.point == point && figure.side == side &&
             (kind != FigureKind::change || figure.variant == variant);
    });
  }

 private:
  session::FaceSession session_;
  FaceBudget budget_;
};

const CoarseFace& coarse_face() {
  static const CoarseFace face;
  return face;
}

TEST(FaceBudget, HasEveryFigureOfTheRun) {
  const CoarseFace& face = coarse_face();
  const auto& pairs = face.session().symmetry().excursions.pairs;
  EXPECT_EQ(face.budget().figures.size(), 7 * pairs.size()) << "R, L, difference, four changes";
  EXPECT_EQ(face.budget().corners, "cheilion");
  EXPECT_TRUE(face.budget().jitter_known);
  EXPECT_EQ(face.budget().assumed.size(), 8u);
  const auto& changed = face.session().variants().at(0).symmetry.excursions.pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const auto& name = pairs[i].name;
    EXPECT_EQ(face.figure(FigureKind::excursion, name, 'R').value_mm,
              pairs[i].right_side.excursion_mm);
    EXPECT_EQ(face.figure(FigureKind::difference, name, 0).value_mm, pairs[i].difference_mm());
    const BudgetedFigure& change = face.figure(FigureKind::change, name, 'L');
    EXPECT_EQ(change.variant, "stiff, right");
    EXPECT_NEAR(change.value_mm,
                changed[i].left_side.excursion_mm - pairs[i].left_side.excursion_mm, 1e-12);
  }
}

TEST(FaceBudget, JitterOfOneSideIsHalfOfThatOfADifference) {
  const CoarseFace& face = coarse_face();
  const auto variance = [&](FigureKind kind, char side, ErrorPart part) {
    return face.figure(kind, "cheilion", side).errors.variance(part);
  };
  const double both = variance(FigureKind::difference, 0, ErrorPart::jitter);
  EXPECT_GT(both, 0);
  EXPECT_NEAR(variance(FigureKind::excursion, 'R', ErrorPart::jitter), both / 2, 1e-12);
  const BudgetedFigure& change = face.figure(FigureKind::change, "cheilion", 'R');
  const double share =
      change.value_mm / face.figure(FigureKind::excursion, "cheilion", 'R').value_mm;
  EXPECT_NEAR(change.errors.variance(ErrorPart::jitter), both / 2 * share * share, 1e-12);
}

/// What is found too small of a change: of muscles 15 %, of tissue 20 %.
TEST(FaceBudget, InversionIsAShareOfTheChange) {
  const CoarseFace& face = coarse_face();
  for (const auto& [variant, share] : {std::pair{"stiff, right", 0.2}, {"weak, right", 0.15}}) {
    const BudgetedFigure& change = face.figure(FigureKind::change, "cheilion", 'R', variant);
    EXPECT_GT(std::abs(change.value_mm), 0.01) << variant;
    EXPECT_NEAR(change.errors.variance(ErrorPart::inversion), std::pow(share * change.value_mm, 2),
                1e-12)
        << variant;
  }
  EXPECT_EQ(
      face.figure(FigureKind::excursion, "cheilion", 'R').errors.variance(ErrorPart::inversion), 0);
}

/// The corners are driven: whatever mesh, muscles or law, they go where they were recorded. A cheek
/// is not.
TEST(FaceBudget, WhatIsDrivenDependsOnTheRecordingAlone) {
  const CoarseFace& face = coarse_face();
  const auto sigma = [&](const std::string& point, ErrorPart part) {
    return std::sqrt(face.figure(FigureKind::excursion, point, 'R').errors.variance(part));
  };
  for (const ErrorPart part : {ErrorPart::mesh, ErrorPart::muscles, ErrorPart::stiffness})
    EXPECT_LT(sigma("cheilion", part), 0.02) << name_of(part);
  EXPECT_GT(sigma("cheek", ErrorPart::mesh), 0.02);
  EXPECT_GT(sigma("cheek", ErrorPart::muscles), 0.02);
  EXPECT_GT(sigma("cheek", ErrorPart::law), 0.02);
}

/// Finite strain does not know this drive: its part is missing, and the rest is there.
TEST(FaceBudget, AFaceThatCannotBeSimulatedIsNamed) {
  session::FaceSession session(scene::read_scene_text(
      "scan.file = \"embedded\"\nmotion.file = \"embedded\"\nmesh.element_size_mm = 8\n"
      "drive.by = \"reactions\"\ntime.step_s = 0.1",
      "made_up.toml"));
  session.run();
  session.find_certainty();
  const FaceBudget budget = face_budget(session);
  ASSERT_EQ(budget.missing.size(), 1u);
  EXPECT_THAT(budget.missing[0], testing::StartsWith("finite strain: "));
  EXPECT_THAT(corner_sentences(budget), testing::Contains(testing::HasSubstr("finite strain")));
}

TEST(FaceBudget, IsWrittenAsATableAndInWords) {
  const CoarseFace& face = coarse_face();
  const TestFolder folder;
  write_budget_csv(folder / "error_budget.csv", face.budget());
  const std::string table = read_file(folder / "error_budget.csv");
  EXPECT_THAT(table, testing::StartsWith(
                         "variant,point,side,figure,value_mm,half_width_95_mm,decided,"
                         "largest_part,jitter_mm,head_pose_mm,landmarks_mm,mesh_mm,muscles_mm,"
                         "inversion_mm,stiffness_mm,law_mm,repetition_mm,"
                         "known_half_width_95_mm,unknown_part\n"));
  EXPECT_THAT(table, testing::HasSubstr("\n\"stiff, right\",cheilion,R,change,"));
  EXPECT_EQ(std::ranges::count(table, '\n'), 1 + int(face.budget().figures.size()));
  const auto sentences = corner_sentences(face.budget());
  ASSERT_EQ(sentences.size(), 7u);
  EXPECT_THAT(sentences[0],
              testing::MatchesRegex("right corner of the mouth: .* mm \\(95 %: .*; mostly .*\\)"));
  EXPECT_THAT(sentences[2], testing::StartsWith("corners of the mouth, left less right: "));
  EXPECT_THAT(sentences[3],
              testing::StartsWith("stiff, right: the right corner of the mouth changes by "));
  const auto json = budget_json(face.budget());
  EXPECT_EQ(json["corners_of_the_mouth"].size(), 7u);
  EXPECT_EQ(json["sentences"].size(), 7u);
}

// The run says "10.1 to 5.9 mm, 4.2 mm less": -4.105 alone would be printed as 4.1.
TEST(FaceBudget, PrintsAChangeAsTheDifferenceOfThePrintedExcursions) {
  BudgetedFigure change{FigureKind::change, "palsy", "cheilion", 'L', -4.105, {}, true};
  change.errors.add(ErrorPart::mesh, 1);
  EXPECT_DOUBLE_EQ(change.shown_mm(), -4.1) << "the excursions are not known";
  change.from_mm = 10.052;
  change.to_mm = 5.947;
  EXPECT_NEAR(change.shown_mm(), -4.2, 1e-12);
  BudgetedFigure none = change;
  none.from_mm = 9.64;
  none.to_mm = 9.66;
  none.value_mm = 0.02;
  EXPECT_EQ(none.shown_mm(), 0) << "unchanged, although 9.6 and 9.7 are printed";
  BudgetedFigure apart = none;
  apart.kind = FigureKind::difference;
  EXPECT_NEAR(apart.shown_mm(), 0.1, 1e-12) << "9.6 and 9.7 stand beside it";
  const FaceBudget budget{.figures = {change},
                          .assumed = {},
                          .missing = {},
                          .corners = "cheilion",
                          .jitter_known = true};
  const auto sentences = corner_sentences(budget);
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_THAT(sentences[0], testing::HasSubstr("changes by -4.2 mm (95 %: -6.1 to -2.1; mostly"));
  EXPECT_NEAR(budget_json(budget)["corners_of_the_mouth"][0]["shown_mm"].get<double>(), -4.2,
              1e-12);
}

// The ends are those of the exact interval, which is narrower here than a rounding error.
TEST(FaceBudget, APrintedIntervalContainsThePrintedValue) {
  BudgetedFigure change{FigureKind::change, "scar", "cheilion", 'L', 0.14, {}, true};
  change.from_mm = 9.549;
  change.to_mm = 9.689;
  change.errors.add(ErrorPart::mesh, 1e-6);
  const FaceBudget budget{.figures = {change},
                          .assumed = {},
                          .missing = {},
                          .corners = "cheilion",
                          .jitter_known = true};
  EXPECT_THAT(corner_sentences(budget)[0], testing::HasSubstr(" 0.2 mm (95 %: 0.1 to 0.2; "));
}

TEST(FaceBudget, KnowsTheExcursionsThatAChangeIsMadeOf) {
  const CoarseFace& face = coarse_face();
  const BudgetedFigure& change = face.figure(FigureKind::change, "cheilion", 'R');
  EXPECT_EQ(change.from_mm, face.figure(FigureKind::excursion, "cheilion", 'R').value_mm);
  EXPECT_NEAR(change.to_mm - change.from_mm, change.value_mm, 1e-12);
  const BudgetedFigure& apart = face.figure(FigureKind::difference, "cheilion", 0);
  EXPECT_NEAR(apart.to_mm - apart.from_mm, apart.value_mm, 1e-12);
  EXPECT_TRUE(std::isnan(face.figure(FigureKind::excursion, "cheilion", 'R').from_mm));
}

TEST(FaceBudget, CountsNoUnknownJitterAsNone) {
  BudgetedFigure change{FigureKind::change, "weak", "cheilion", 'R', -3, {}, false};
  change.errors.add(ErrorPart::mesh, 0.25);
  EXPECT_TRUE(std::isnan(change.half_width_95_mm()));
  EXPECT_NEAR(change.known_half_width_95_mm(), 1.96 * 0.5, 1e-3);
  EXPECT_EQ(change.decided(), std::nullopt);
  BudgetedFigure small = change;
  small.value_mm = -0.9;
  EXPECT_EQ(small.decided(), false) << "what is known is enough to doubt it";
  BudgetedFigure exact = change;
  exact.jitter_known = true;
  EXPECT_EQ(exact.decided(), true);
  const FaceBudget budget{
      .figures = {change, small}, .assumed = {}, .missing = {}, .corners = "cheilion"};
  const TestFolder folder;
  write_budget_csv(folder / "error_budget.csv", budget);
  const std::string table = read_file(folder / "error_budget.csv");
  EXPECT_THAT(table, testing::HasSubstr("\nweak,cheilion,R,change,-3,,,,,0,0,0.98,"));
  EXPECT_THAT(table, testing::HasSubstr("\nweak,cheilion,R,change,-0.9,,0,,,0,0,0.98,"));
  EXPECT_THAT(table, testing::HasSubstr(",0.98,jitter\n"));
  const auto sentences = corner_sentences(budget);
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_THAT(sentences[0], testing::HasSubstr("changes by -3.0 mm (at least +- 1.0; mostly mesh), "
                                               "cannot tell"));
  EXPECT_THAT(sentences[1], testing::EndsWith("undecided"));
  EXPECT_THAT(sentences[2], testing::HasSubstr("jitter is not known"));
  const auto json = budget_json(budget)["corners_of_the_mouth"][0];
  EXPECT_THAT(json.dump(), testing::HasSubstr("\"half_width_95_mm\":null"));
  EXPECT_TRUE(json["decided"].is_null());
  EXPECT_EQ(json["unknown_part"], "jitter");
}

}  // namespace
}  // namespace hyperex::uncertainty
