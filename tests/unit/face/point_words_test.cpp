// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/point_words.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hyperex/face/canonical_face.hpp"

namespace hyperex::face {
namespace {

TEST(PointWords, NameEveryLandmarkOnceAndWithItsSide) {
  std::set<std::string> seen;
  const CanonicalFace& face = canonical_face();
  for (const auto& [name, vertices] : face.landmarks) {
    const std::string words = point_words(name);
    EXPECT_TRUE(seen.insert(words).second) << name << ": " << words << " names another point too";
    EXPECT_EQ(words.find('_'), words.npos) << words;
    EXPECT_EQ(words.find("ibug"), words.npos) << words;
    // +x is the subject's left.
    const double x = face.landmark(name, face.mesh.points).x();
    EXPECT_EQ(words.ends_with(", left"), x > 1e-4) << name << ": " << words;
    EXPECT_EQ(words.ends_with(", right"), x < -1e-4) << name << ": " << words;
  }
  EXPECT_EQ(seen.size(), 68u + 24u);
}

TEST(PointWords, OfMirroredPointsDifferInTheSideAlone) {
  const auto without_side = [](const std::string& words) {
    return words.substr(0, words.rfind(", "));
  };
  for (const auto& [name, vertices] : canonical_face().landmarks) {
    const std::string other = mirrored_landmark(name);
    if (other == name) continue;
    EXPECT_EQ(without_side(point_words(name)), without_side(point_words(other)));
  }
}

TEST(PointWords, KnowPairsAndLeaveOtherNames) {
  EXPECT_EQ(point_words("ibug68_54"), "corner of the mouth, left");
  EXPECT_EQ(point_words("ibug68_48/54"), "corner of the mouth");
  EXPECT_EQ(point_words("cheilion"), "corner of the mouth (cheilion)");
  EXPECT_EQ(point_words("cheilion_R"), "corner of the mouth (cheilion), right");
  EXPECT_EQ(point_words("ibug68_68"), "ibug68 68");
  EXPECT_EQ(point_words("ibug68_x"), "ibug68 x");
  EXPECT_EQ(point_words("my_marker_L"), "my marker L");
  EXPECT_EQ(point_words(""), "");
}

TEST(PointWords, StandBesideTheNameInMessages) {
  EXPECT_EQ(name_in_words("ibug68_54"), "ibug68_54 (corner of the mouth, left)");
  EXPECT_EQ(name_in_words("cheilion_R"), "cheilion_R (corner of the mouth, right)");
  EXPECT_EQ(name_in_words("ibug68_8", "3.1 mm"), "ibug68_8 (chin; 3.1 mm)");
  EXPECT_EQ(name_in_words("pogonion", "3.1 mm"), "pogonion (chin; 3.1 mm)");
  EXPECT_EQ(name_in_words("head_1", "3.1 mm"), "head_1 (3.1 mm)");
  for (const char* name : {"head_1", "my_marker_L", "ibug68_68", "_L", ""})
    EXPECT_EQ(name_in_words(name), name);
}

}  // namespace
}  // namespace hyperex::face
