// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/optional_landmarks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/point_words.hpp"

namespace hyperex::face {
namespace {

TEST(OptionalLandmarks, AreThreeOfEachFoldInOrder) {
  EXPECT_THAT(optional_landmarks(),
              testing::ElementsAre("nasolabial_fold_lower_L", "nasolabial_fold_lower_R",
                                   "nasolabial_fold_middle_L", "nasolabial_fold_middle_R",
                                   "nasolabial_fold_upper_L", "nasolabial_fold_upper_R"));
  EXPECT_EQ(fold_landmark(FoldPoint::middle, false), "nasolabial_fold_middle_R");
}

TEST(OptionalLandmarks, AreKnownAndNotOfTheCanonicalFace) {
  for (const std::string& name : optional_landmarks()) {
    EXPECT_TRUE(is_optional_landmark(name)) << name;
    EXPECT_TRUE(is_known_landmark(name)) << name;
    EXPECT_FALSE(canonical_face().landmarks.contains(name)) << name;
    EXPECT_TRUE(is_optional_landmark(mirrored_landmark(name))) << name;
    EXPECT_NE(mirrored_landmark(name), name);
  }
  EXPECT_TRUE(is_known_landmark("cheilion_L"));
  for (const char* name : {"cheilion_L", "ibug68_48", "nasolabial_fold", "nasolabial_fold_upper"})
    EXPECT_FALSE(is_optional_landmark(name)) << name;
  EXPECT_FALSE(is_known_landmark("nasolabial_fold_upper"));
}

TEST(OptionalLandmarks, HaveWordsOfTheirOwn) {
  std::set<std::string> words;
  for (const auto& entry : canonical_face().landmarks) words.insert(point_words(entry.first));
  for (const std::string& name : optional_landmarks())
    EXPECT_TRUE(words.insert(point_words(name)).second) << name;
  EXPECT_EQ(point_words("nasolabial_fold_upper_L"),
            "fold from nose to mouth, upper end (nasolabial fold), left");
  EXPECT_EQ(name_in_words("nasolabial_fold_lower_R"),
            "nasolabial_fold_lower_R (fold from nose to mouth, lower end, right)");
}

}  // namespace
}  // namespace hyperex::face
