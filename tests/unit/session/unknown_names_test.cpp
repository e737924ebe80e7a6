// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/unknown_names.hpp"

#include <gmock/gmock.h>

#include "support/note_matchers.hpp"

namespace hyperex::session {
namespace {

TEST(NearestLandmark, FindsTheSlipAndKeepsTheSide) {
  for (const auto& [given, meant] : {std::pair{"cheilon_L", "cheilion_L"},
                                     {"cheilion_r", "cheilion_R"},
                                     {"left_alare", "alare_L"},
                                     {"exocanthion_right", "exocanthion_R"},
                                     {"Nasion", "nasion"},
                                     {"pogonoin", "pogonion"},
                                     {"nasolabial_fold_uper_L", "nasolabial_fold_upper_L"},
                                     {"nasolabial_fold_middle_right", "nasolabial_fold_middle_R"},
                                     {"ibug_48", "ibug68_48"},
                                     {"54", "ibug68_54"}})
    EXPECT_EQ(nearest_landmark(given), meant) << given;
}

TEST(NearestLandmark, GuessesNoSideAndNothingFarOff) {
  EXPECT_EQ(nearest_landmark("cheilion"), "cheilion_L or cheilion_R");
  for (const char* name : {"my_own_mark", "ibug68_99", "scar_12", "cheilion_L",
                           "nasolabial_fold_lower_R", "nasolabial_fold_L", "", "x"})
    EXPECT_EQ(nearest_landmark(name), "") << name;
}

TEST(NearestRegion, KeepsTheSide) {
  EXPECT_EQ(nearest_region("\"right_cheek\""), "cheek_R");
  EXPECT_EQ(nearest_region("cheek_r"), "cheek_R");
  EXPECT_EQ(nearest_region("chek"), "cheek");
  EXPECT_EQ(nearest_region("cheek_R"), "");
  EXPECT_EQ(nearest_region("elbow"), "");
  EXPECT_EQ(nearest_region("side_R"), "face_R");
  EXPECT_EQ(nearest_region("left_half"), "face_L");
}

TEST(DidYouMeanRegion, IsSaidOfNamesOfRegionsAlone) {
  EXPECT_EQ(did_you_mean_region("tissue.region[0].name", "\"cheek_left\""),
            "; did you mean cheek_L?");
  EXPECT_EQ(did_you_mean_region("tissue.region[0].scar", "\"cheek_left\""), "");
  EXPECT_EQ(did_you_mean_region("tissue.region[0].name", "\"elbow\""), "");
}

TEST(DidYouMean, IsNoOtherPartOfTheFace) {
  const std::vector<std::string> there = {"ibug68_8", "ibug68_54", "cheilion_R", "head_3"};
  EXPECT_EQ(did_you_mean("ibug68_48", there), "; did you mean cheilion_R?");
  EXPECT_EQ(did_you_mean("ibug_54", there), "; did you mean ibug68_54?");
  EXPECT_EQ(did_you_mean("hed_3", there), "; did you mean head_3?");
  for (const char* name : {"ibug68_58", "ibug68_88", "ibug68_84", "alare_L"})
    EXPECT_EQ(did_you_mean(name, there), "") << name;
}

TEST(MisspeltLandmarks, AreTakenOutOfTheUnknown) {
  std::vector<std::string> unknown = {"cheilon_L", "my_own_mark"};
  EXPECT_THAT(misspelt_landmarks(unknown),
              testing::ElementsAre(testing::AllOf(
                  test::is_warning("landmarks.misspelt"), test::is_about("scan.landmarks"),
                  test::says("cheilon_L"), test::says("cheilion_L?"))));
  EXPECT_THAT(unknown, testing::ElementsAre("my_own_mark"));
}

}  // namespace
}  // namespace hyperex::session
