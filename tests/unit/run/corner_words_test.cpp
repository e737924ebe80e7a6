// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/corner_words.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Corner {
  double from_mm, to_mm, along_mm, band_mm = 0.3;
};

Json summary_of(const Corner& right, const Corner& left, const Json& weaker) {
  Json base{{"name", "base"}}, variant{{"name", "what if"}, {"weaker_sides", weaker}};
  for (const auto& [side, corner] : {std::pair{"R", right}, std::pair{"L", left}}) {
    const std::string key = std::string("commissure_") + side;
    base[key + "_mm"] = corner.from_mm;
    variant[key + "_mm"] = corner.to_mm;
    variant[key + "_along_base_mm"] = corner.along_mm;
    variant[key + "_band_mm"] = corner.band_mm;
  }
  return {{"symmetry",
           {{"commissure",
             {{"excursion_mm", {{"L", left.from_mm}, {"R", right.from_mm}}},
              {"floor_mm", 0.1},
              {"mesh_floor_mm", 0.1}}}}},
          {"variants", {{"table", {base, variant}}}}};
}

const Corner same{6.7, 6.72, 6.72};

TEST(CornerWords, ACornerThatIsNotRecordedHasNoFigure) {
  Json summary = summary_of({std::nan(""), std::nan(""), std::nan("")}, same, Json::array());
  Json& corners = summary["symmetry"]["commissure"];
  corners["excursion_mm"]["R"] = nullptr;
  corners["recorded"] = {{"R", false}, {"L", true}};
  EXPECT_EQ(corners_line(summary),
            "corners of the mouth: right not recorded, left 6.7 mm: a difference of the sides is "
            "not known\n");
  EXPECT_THAT(variant_lines(summary),
              HasSubstr("corner of the mouth right not recorded; left 6.7 mm, unchanged"));
  corners["excursion_mm"]["L"] = nullptr;
  corners["recorded"]["L"] = false;
  EXPECT_THAT(corners_line(summary), HasSubstr("right not recorded, left not recorded: "));
}

// As the mouth opens, the weak corner moves farther, and the healthy one does not move less.
TEST(CornerWords, AWeakCornerThatGoesFartherIsDragged) {
  const std::string lines = variant_lines(summary_of({6.7, 8.9, 8.85}, same, {"R"}));
  EXPECT_THAT(lines, HasSubstr("right 6.7 to 8.9 mm, is dragged 2.2 mm farther (+- 0.3)"));
  EXPECT_THAT(lines, HasSubstr("; left 6.7 mm, unchanged\n"));
  EXPECT_THAT(lines, Not(HasSubstr("less")));
}

TEST(CornerWords, AWeakCornerMovesLessAndOneInStiffTissueFollowsLess) {
  const Corner less{9.6, 6.2, 6.15};
  EXPECT_THAT(variant_lines(summary_of(less, same, {"R"})), HasSubstr("moves 3.4 mm less"));
  EXPECT_THAT(variant_lines(summary_of(less, same, Json::array())),
              HasSubstr("follows 3.4 mm less"));
  EXPECT_THAT(variant_lines(summary_of({6.7, 7.5, 7.5}, same, Json::array())),
              HasSubstr("moves 0.8 mm farther"));
}

// The change is that of the distance from rest, as variants_excursions.csv has it, with its own
// band. What it hides where the corner turns aside is a second figure with a name.
TEST(CornerWords, ACornerThatTurnsAsideHasASecondFigureInTheUnchangedDirection) {
  EXPECT_THAT(
      variant_lines(summary_of({10.12, 6.68, 4.24, 0.69}, same, {"R"})),
      AllOf(HasSubstr("right 10.1 to 6.7 mm, moves 3.4 mm less (+- 0.7); left 6.7 mm, "
                      "unchanged\n    right corner: in the unchanged direction 10.1 to 4.2 mm, 5.9 "
                      "mm less\n"),
            HasSubstr("(the unchanged direction: where the corner goes without the change;")));
  EXPECT_THAT(variant_lines(summary_of({6.0, 6.4, 3.9}, same, {"R"})),
              AllOf(HasSubstr("right 6.0 to 6.4 mm, is dragged 0.4 mm farther (+- 0.3); left"),
                    HasSubstr("corner: in the unchanged direction 6.0 to 3.9 mm, 2.1 mm less\n")));
  EXPECT_THAT(variant_lines(summary_of({6.0, 5.9, -5.2}, same, {"R"})),
              AllOf(HasSubstr("undecided: 0.1 mm less (+- 0.3); left"),
                    HasSubstr("right corner: 5.2 mm against the unchanged direction")));
  EXPECT_THAT(variant_lines(summary_of({6.0, 6.02, 3.9}, same, {"R"})),
              AllOf(HasSubstr("right 6.0 mm, as far as before; left"),
                    HasSubstr("corner: in the unchanged direction 6.0 to 3.9 mm, 2.1 mm less\n")));
  EXPECT_THAT(variant_lines(summary_of({9.6, 6.2, 6.15}, same, {"R"})),
              Not(HasSubstr("unchanged direction")));
}

/// The right corner goes from 10.12 to 6.68 mm, and to `along_mm` in the unchanged direction.
Json with_along_band(double along_mm, const Json& band_mm, const Json& decided) {
  Json summary = summary_of({10.12, 6.68, along_mm, 0.69}, same, {"R"});
  Json& changed = summary["variants"]["table"][1];
  changed["commissure_R_along_base_band_mm"] = band_mm;
  changed["commissure_R_along_base_decided"] = decided;
  return summary;
}

TEST(CornerWords, TheFigureInTheUnchangedDirectionHasABandOfItsOwn) {
  EXPECT_THAT(
      variant_lines(with_along_band(4.24, 0.82, 1)),
      HasSubstr("corner: in the unchanged direction 10.1 to 4.2 mm, 5.9 mm less (+- 0.8)\n"));
  EXPECT_THAT(variant_lines(with_along_band(-2.1, 0.82, 1)),
              HasSubstr(": 2.1 mm against the unchanged direction, 12.2 mm less (+- 0.8)\n"));
  EXPECT_THAT(variant_lines(with_along_band(9.7, 0.82, 0)),
              HasSubstr("10.1 to 9.7 mm, undecided: 0.4 mm less (+- 0.8)\n"));
}

TEST(CornerWords, TheFigureInTheUnchangedDirectionIsNotDecidedWhereTheJitterIsNotKnown) {
  Json summary = with_along_band(4.24, nullptr, nullptr);
  summary["variants"]["table"][1]["jitter_known"] = false;
  EXPECT_THAT(variant_lines(summary), HasSubstr("5.9 mm less (cannot tell)\n"));
  summary["variants"]["table"][1]["commissure_R_along_base_decided"] = 0;
  EXPECT_THAT(variant_lines(summary), HasSubstr("undecided: 5.9 mm less\n"));
}

TEST(CornerWords, SaysOneSecondFigureAtMost) {
  Json summary = summary_of({9.72, 7.53, 6.72, 0.96}, same, {"R"});
  Json& changed = summary["variants"]["table"][1];
  changed["commissure_R_from_base_mm"] = 4.6;
  changed["commissure_R_from_base_s"] = 1.2;
  EXPECT_THAT(variant_lines(summary),
              AllOf(HasSubstr("right 9.7 to 7.5 mm, moves 2.2 mm less (+- 1.0); left"),
                    HasSubstr("corner: in the unchanged direction 9.7 to 6.7 mm, 3.0 mm less\n"),
                    Not(HasSubstr("at 1.20 s"))));
}

TEST(CornerWords, WhatStillMovesASideThatNoMusclePulls) {
  Json summary = summary_of({10.12, 6.68, 6.6, 0.69}, same, {"R"});
  EXPECT_THAT(variant_lines(summary), Not(HasSubstr("no muscle pulls")));
  Json& changed = summary["variants"]["table"][1];
  changed["unpulled_sides"] = Json::array({"R"});
  changed["commissure_R_with_jaw_mm"] = 5.04;
  EXPECT_THAT(
      variant_lines(summary),
      HasSubstr("\n    no muscle pulls on the right: its corner moves by no strength of its "
                "own, but by the jaw and the other side. "
                "Fixed to the lower jaw it would go 5.0 mm. Skin follows the jaw in part\n"));
  changed["commissure_R_with_turned_jaw_mm"] = 3.16;
  EXPECT_THAT(variant_lines(summary), Not(HasSubstr("3.2 mm"))) << "one figure in a breath";
  for (const Json& unknown : {Json(), Json(std::nan(""))}) {
    changed["commissure_R_with_jaw_mm"] = unknown;
    EXPECT_THAT(variant_lines(summary), HasSubstr("by the jaw and the other side\n"));
  }
}

TEST(CornerWords, AChangeIsNotDecidedWhereTheJitterIsNotKnown) {
  Json summary = summary_of({9.6, 6.2, 6.15}, {8.3, 8.0, 8.0}, {"R"});
  Json& variant = summary["variants"]["table"][1];
  variant["jitter_known"] = false;
  variant["commissure_R_band_mm"] = variant["commissure_L_band_mm"] = nullptr;
  variant["commissure_R_decided"] = nullptr;
  variant["commissure_L_decided"] = 0;
  const std::string lines = variant_lines(summary);
  EXPECT_THAT(lines, HasSubstr("moves 3.4 mm less (cannot tell: the recording's jitter is not "
                               "known)"));
  EXPECT_THAT(lines, HasSubstr("left 8.3 to 8.0 mm, undecided: 0.3 mm less"));
}

TEST(CornerWords, APathThatDiffersIsSaidWithTheTimeAndNoOtherPlace) {
  const auto words = [](const Corner& left) {
    Json summary = summary_of(same, left, {"L"});
    Json& changed = summary["variants"]["table"][1];
    changed["commissure_L_from_base_mm"] = 6.58;
    changed["commissure_L_from_base_s"] = 3.63;
    return variant_lines(summary);
  };
  const std::string on_the_way =
      "\n    left corner: at 3.63 s it is 6.6 mm from where it is without the change\n";
  EXPECT_THAT(words({16.4, 16.0, 16.0, 0.2}),
              HasSubstr("left 16.4 to 16.0 mm, moves 0.4 mm less (+- 0.2)" + on_the_way));
  EXPECT_THAT(words({9.98, 10.1, 10.1, 0.05}), HasSubstr("0.12 mm farther (+- 0.05)" + on_the_way));
  EXPECT_THAT(words({16.4, 16.0, 16.0, 0.5}),
              HasSubstr("undecided: 0.4 mm less (+- 0.5)" + on_the_way));
  EXPECT_THAT(words(same), HasSubstr("left 6.7 mm, as far as before" + on_the_way));
}

TEST(CornerWords, SaysWhichFigureToQuoteAfterAllVariants) {
  Json summary = summary_of({10.12, 6.68, 4.24, 0.69}, {9.7, 8.1, 8.1}, {"R"});
  summary["variants"]["table"].push_back(summary["variants"]["table"][1]);
  const std::string lines = variant_lines(summary);
  const std::size_t quote = lines.find("(quote the excursions, in the first line of each variant");
  ASSERT_NE(quote, std::string::npos) << lines;
  EXPECT_GT(quote, lines.rfind("right corner: in the unchanged direction"));
  EXPECT_EQ(lines.find("quote", quote + 10), std::string::npos) << "once";
}

/// The corners' figures of an error budget: the left one's change and the difference of both.
Json budget_with(const Json& half_mm, double known_half_mm, const Json& decided) {
  const Json change{{"variant", "what if"},
                    {"figure", "change"},
                    {"side", "L"},
                    {"value_mm", -4.105},
                    {"half_width_95_mm", half_mm},
                    {"known_half_width_95_mm", known_half_mm},
                    {"decided", decided},
                    {"largest_part", "muscles"}};
  Json difference = change;
  difference.erase("variant");
  difference.erase("side");
  difference["figure"] = "difference";
  return {{"corners_of_the_mouth", Json::array({difference, change})}};
}

// The band is of one other mesh and the jitter. Beside the budget's interval it would look decided.
TEST(CornerWords, TheIntervalOfTheErrorBudgetStandsInPlaceOfTheBand) {
  Json summary = summary_of(same, {10.052, 5.947, 5.947, 0.4}, {"L"});
  EXPECT_THAT(variant_lines(summary), HasSubstr("moves 4.2 mm less (+- 0.4)\n"));
  summary["error_budget"] = budget_with(2.868, 2.868, true);
  EXPECT_THAT(variant_lines(summary),
              AllOf(HasSubstr("left 10.1 to 5.9 mm, moves 4.2 mm less (95 %: +- 2.9)\n"),
                    HasSubstr("+-: what all errors of the error budget together could make"),
                    Not(HasSubstr("--error-budget"))));
  summary["error_budget"] = budget_with(4.868, 4.868, false);
  EXPECT_THAT(variant_lines(summary), HasSubstr("undecided: 4.2 mm less (95 %: +- 4.9)\n"));
  summary["error_budget"] = budget_with(nullptr, 1.4, nullptr);
  EXPECT_THAT(variant_lines(summary),
              HasSubstr("moves 4.2 mm less (at least +- 1.4) (cannot tell: the recording's jitter "
                        "is not known)\n"));
}

TEST(CornerWords, TheErrorBudgetHasNoIntervalInTheUnchangedDirection) {
  Json summary = summary_of(same, {10.052, 5.947, 3.707, 0.4}, {"L"});
  summary["variants"]["table"][1]["commissure_L_along_base_band_mm"] = 0.8;
  EXPECT_THAT(variant_lines(summary), HasSubstr("10.1 to 3.7 mm, 6.4 mm less (+- 0.8)\n"));
  summary["error_budget"] = budget_with(2.868, 2.868, true);
  EXPECT_THAT(variant_lines(summary),
              AllOf(HasSubstr("(95 %: +- 2.9)\n    left corner: in the unchanged direction 10.1 to "
                              "3.7 mm, 6.4 mm less\n"),
                    HasSubstr("not in it; the error budget has no interval for it)")));
}

TEST(CornerWords, TheIntervalOfTheErrorBudgetStandsInPlaceOfTheFloor) {
  Json summary = summary_of({6.0, 6.0, 6.0}, {7.04, 7.0, 7.0}, Json::array());
  summary["error_budget"] = budget_with(0.84, 0.84, true);
  EXPECT_THAT(corners_line(summary),
              HasSubstr("a difference of 1.0 mm (95 %: +- 0.8; mostly muscles)\n"));
  summary["error_budget"] = budget_with(1.84, 1.84, false);
  EXPECT_THAT(corners_line(summary), HasSubstr("(95 %: +- 1.8; mostly muscles): undecided\n"));
  summary["error_budget"] = budget_with(nullptr, 0.5, nullptr);
  EXPECT_THAT(corners_line(summary),
              HasSubstr("(at least +- 0.5; mostly muscles): cannot tell, as the recording's jitter "
                        "is not known\n"));
}

// 9.64 and 9.66 would be 9.6 and 9.7 if each were rounded separately.
TEST(CornerWords, RoundsOnceSoThatAdjacentFiguresAgree) {
  const Json summary = summary_of({9.64, 9.66, 9.66}, {8.26, 6.24, 6.24}, Json::array());
  EXPECT_THAT(corners_line(summary),
              HasSubstr("right 9.6 mm, left 8.3 mm, a difference of 1.3 mm"));
  EXPECT_THAT(variant_lines(summary), HasSubstr("right 9.6 mm, unchanged"));
  EXPECT_THAT(variant_lines(summary), HasSubstr("left 8.3 to 6.2 mm, follows 2.1 mm less"));
}

TEST(CornerWords, NamesTheLargestPartOfTheFloor) {
  Json summary = summary_of({6.0, 6.0, 6.0}, {7.0, 7.0, 7.0}, Json::array());
  Json& corners = summary["symmetry"]["commissure"];
  EXPECT_THAT(corners_line(summary),
              HasSubstr("a difference of 1.0 mm: more than the floor of 0.1 mm (mesh)"));
  corners["floor_mm"] = 1.26;
  corners["undecided"] = true;
  corners["largest_part"] = "head pose";
  EXPECT_THAT(corners_line(summary), HasSubstr("undecided, below the floor of 1.3 mm (head pose)"));
}

// 0.4 and 0.4 mm: with one decimal the difference would not be more than the floor.
TEST(CornerWords, ADifferenceAndItsFloorHaveAsManyDecimalsAsTellThemApart) {
  Json summary = summary_of({9.655, 6.0, 6.0}, {10.124, 7.0, 7.0}, Json::array());
  Json& corners = summary["symmetry"]["commissure"];
  corners["floor_mm"] = 0.4092;
  EXPECT_THAT(
      corners_line(summary),
      HasSubstr("right 9.7 mm, left 10.1 mm, a difference of 0.47 mm: more than the floor of "
                "0.41 mm (mesh)"));
}

TEST(CornerWords, NoDifferenceIsDecidedWhereTheJitterIsNotKnown) {
  Json summary = summary_of({6.0, 6.0, 6.0}, {7.0, 7.0, 7.0}, Json::array());
  Json& corners = summary["symmetry"]["commissure"];
  corners["undecided"] = nullptr;
  EXPECT_THAT(corners_line(summary),
              HasSubstr("a difference of 1.0 mm: more than the floor of 0.1 mm (mesh), but the "
                        "recording cannot tell, as its jitter is not known\n"));
  corners["floor_mm"] = nullptr;
  EXPECT_THAT(corners_line(summary),
              HasSubstr("a difference of 1.0 mm: the recording cannot tell, as its jitter is not "
                        "known\n"));
}

TEST(CornerWords, TheHeadsMotionIsNotCalledJitter) {
  Json summary = summary_of({6.0, 6.0, 6.0}, {7.0, 7.0, 7.0}, Json::array());
  Json& corners = summary["symmetry"]["commissure"];
  corners["undecided"] = nullptr;
  corners["jitter_floor_mm"] = 0.2;
  EXPECT_THAT(corners_line(summary),
              HasSubstr("but the recording cannot tell, as the head's motion is in its points\n"));
}

// What rounding leaves of the pose's floor, where no point has noise.
TEST(CornerWords, AFloorThatWouldBePrintedAsZeroIsNone) {
  Json summary = summary_of({6.0, 6.0, 6.0}, {7.0, 7.0, 7.0}, Json::array());
  Json& corners = summary["symmetry"]["commissure"];
  corners["floor_mm"] = 1.4e-14;
  corners["largest_part"] = "head pose";
  EXPECT_THAT(corners_line(summary), HasSubstr("a difference of 1.0 mm\n"));
  corners["undecided"] = nullptr;
  EXPECT_THAT(corners_line(summary),
              HasSubstr("a difference of 1.0 mm: the recording cannot tell, as its jitter is not "
                        "known\n"));
}

TEST(CornerWords, OfARecordingAreThoseOfARun) {
  metrics::Excursions excursions;
  EXPECT_EQ(corners_line(excursions), "");
  metrics::PairExcursion pair;
  pair.left = 1;
  pair.right = 0;
  pair.right_side.excursion_mm = 9.86;
  pair.left_side.excursion_mm = 4.07;
  pair.jitter_floor_mm = 0.15;
  pair.pose_floor_mm = 0.3;
  excursions.pairs = {pair};
  excursions.commissure.left = 1;
  excursions.commissure.right = 0;
  EXPECT_EQ(
      corners_line(excursions),
      "corners of the mouth: right 9.9 mm, left 4.1 mm, a difference of 5.8 mm: more than the "
      "floor of 0.3 mm (head pose)\n");
  EXPECT_THAT(corners_line(excursions, true),
              HasSubstr("floor of 0.3 mm (head pose); doubtful, see the warning above\n"));
  excursions.commissure.left = 2;
  EXPECT_EQ(corners_line(excursions, true), "");
  EXPECT_EQ(corners_line(excursions), "") << "the pair of other points";
}

TEST(CornerWords, TheRunSaysInWhoseMillimetresItIs) {
  Json summary{{"remarks", {{{"id", "recording.aligned"}, {"text", "aligned"}}}}};
  EXPECT_EQ(rescaled_line(summary), "");
  summary["remarks"].push_back({{"id", "recording.rescaled"}, {"text", "of the scan"}});
  EXPECT_EQ(rescaled_line(summary), "of the scan\n");
  EXPECT_EQ(rescaled_line(Json::object()), "");
}

TEST(CornerWords, AChangeWithinItsBandIsUndecided) {
  EXPECT_THAT(variant_lines(summary_of({6.7, 7.0, 7.0, 0.5}, same, {"R"})),
              HasSubstr("right 6.7 to 7.0 mm, undecided: 0.3 mm more (+- 0.5)"));
}

}  // namespace
}  // namespace hyperex::run
