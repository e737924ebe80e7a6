// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/same_place.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "hyperex/face/ibug.hpp"

namespace hyperex::face {
namespace {

TEST(SamePlace, IsFoundUnderEitherName) {
  const Vec3 left(1, 2, 3), other(4, 5, 6);
  EXPECT_EQ(find_place({{ibug(54), left}}, "cheilion_L"), left);
  EXPECT_EQ(find_place({{"cheilion_L", left}}, ibug(54)), left);
  const io::Landmarks both = {{"cheilion_L", left}, {ibug(54), other}};
  EXPECT_EQ(find_place(both, "cheilion_L"), left) << "the name asked for counts first";
  EXPECT_EQ(find_place(both, ibug(54)), other);
}

TEST(SamePlace, ThatIsNotGivenOrNotFiniteIsNone) {
  EXPECT_FALSE(find_place({{"cheilion_R", Vec3::Zero()}}, "cheilion_L"));
  EXPECT_FALSE(find_place({}, "my_own"));
  const Vec3 nowhere = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(find_place({{"cheilion_L", nowhere}}, "cheilion_L"));
}

TEST(SamePlace, HasOneName) {
  for (const char* name : {"36", "p36", "ibug68_36", "exocanthion_R"})
    EXPECT_EQ(place_name(name), "ibug68_36") << name;
  for (const char* name : {"pogonion", "head_1", "360", "p", "", "ibug68_99", "99", "p68"})
    EXPECT_EQ(place_name(name), name);
}

TEST(SamePlace, HasANumber) {
  for (const char* name : {"48", "p48", "ibug68_48", "cheilion_R"})
    EXPECT_EQ(ibug_number_of_place(name), 48) << name;
  EXPECT_EQ(ibug_number_of_place("08"), 8);
  for (const char* name : {"pogonion", "head_1", "480", "p", "", "ibug68_99", "99", "p68"})
    EXPECT_FALSE(ibug_number_of_place(name)) << name;
}

}  // namespace
}  // namespace hyperex::face
