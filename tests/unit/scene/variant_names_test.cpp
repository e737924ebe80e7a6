// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/scene/variant_names.hpp"

#include <gtest/gtest.h>

namespace hyperex::scene {
namespace {

TEST(VariantNames, HoldWhatPeopleWrite) {
  for (const char* name :
       {"a", "stiff, right", "E = 400 kPa (x2)", "Bell's palsy", "50%", "-1.", "..a", "[1]"})
    EXPECT_TRUE(is_variant_name(name)) << name;
  for (const std::string name : {"", " ", "..", "a/b", "a\\b", "a\"b", "<b>", "a\nb", "\xc3\xbc"})
    EXPECT_FALSE(is_variant_name(name)) << name;
  EXPECT_TRUE(is_variant_name(std::string(100, 'a')));
  EXPECT_FALSE(is_variant_name(std::string(101, 'a')));
}

TEST(VariantNames, OfABlockAreItsOwnOrItsPresets) {
  EXPECT_EQ(name_of_block({{"name", "a"}, {"preset", "aged"}}), "a");
  EXPECT_EQ(name_of_block({{"preset", "aged"}}), "aged");
  EXPECT_EQ(name_of_block({{"tissue", 1}}), "");
}

TEST(VariantNames, EachHasAFolderOfItsOwn) {
  std::vector<Variant> others;
  const auto next = [&](const std::string& name) {
    Variant variant;
    variant.name = name;
    variant.folder = variant_folder(name, others);
    others.push_back(variant);
    return variant.folder;
  };
  EXPECT_EQ(next("stiff right cheek"), "stiff_right_cheek");
  EXPECT_EQ(next("a,b"), "a_b");
  EXPECT_EQ(next("a;b"), "a_b-2");
  EXPECT_EQ(next("a_b-2"), "a_b-2-2");
  EXPECT_EQ(next("a=b"), "a_b-3");
  EXPECT_EQ(next("..a."), "a");
  EXPECT_EQ(next("b "), "b");
  EXPECT_EQ(next("left zygomaticus at 30 %"), "left_zygomaticus_at_30");
  EXPECT_EQ(next("E = 400 kPa (x2)"), "E_400_kPa_x2");
}

}  // namespace
}  // namespace hyperex::scene
