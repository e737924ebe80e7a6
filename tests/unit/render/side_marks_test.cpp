// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/side_marks.hpp"

#include <gtest/gtest.h>

#include "hyperex/render/contact_sheet.hpp"

namespace hyperex::render {
namespace {

SideMarks seen_from(const Vec3& way) {
  return side_marks({.to_viewer = way});
}

// From the front the subject's right is at the left of the picture, from behind at its right.
TEST(SideMarks, NameTheSubjectsOwnSides) {
  for (const Vec3& way : {front_view(), three_quarter_view()}) {
    EXPECT_EQ(seen_from(way).at_left, "R");
    EXPECT_EQ(seen_from(way).at_right, "L");
    EXPECT_EQ(seen_from(way).in_middle, "");
  }
  EXPECT_EQ(seen_from({0, 0.1, -1}).at_left, "L");
  EXPECT_EQ(seen_from({0, 0.1, -1}).at_right, "R");
}

TEST(SideMarks, InProfileNameTheSideThatIsSeen) {
  for (const auto& [way, letter] :
       {std::pair{Vec3(1, 0, 0), "L"}, std::pair{Vec3(-1, 0, 0.2), "R"}}) {
    EXPECT_EQ(seen_from(way).in_middle, letter);
    EXPECT_EQ(seen_from(way).at_left + seen_from(way).at_right, "");
  }
}

TEST(SideMarks, FollowAScanInAnyPose) {
  // Its left is the world's -z; it looks along -x.
  const SideMarks marks =
      side_marks({.to_viewer = {-1, 0, 0}, .up = Vec3::UnitY()}, -2 * Vec3::UnitZ());
  EXPECT_EQ(marks.at_left + marks.at_right, "LR");
}

// The letters add ink where a sheet without marks has none.
TEST(ContactSheet, DrawsTheMarksOverEachPicture) {
  const auto sheet = [](const SideMarks& marks) {
    return contact_sheet({.pictures = {{Image(120, 90), "", marks}}, .columns = 1});
  };
  const Image marked = sheet(seen_from(front_view())), bare = sheet({});
  int left = 0, right = 0;
  for (int y = 0; y < marked.height; ++y)
    for (int x = 0; x < marked.width; ++x)
      if (marked.pixel(x, y)[0] != bare.pixel(x, y)[0]) (x < marked.width / 2 ? left : right) += 1;
  EXPECT_GT(left, 20);
  EXPECT_GT(right, 10);
}

}  // namespace
}  // namespace hyperex::render
