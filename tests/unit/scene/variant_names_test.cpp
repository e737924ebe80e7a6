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

TEST(VariantNames, EachHasAFolderOfItsOwn) {
  std::vector<Variant> others;
  const auto next = [&](const std::string& name) {
    Variant variant;
    variant.name = name;
    variant.folder = variant_folder(name, others);
    others.push_back(variant);
    return variant.folder;
  };
  EXPECT_EQ(next("stiff right cheek"), "stiff right cheek");
  EXPECT_EQ(next("a,b"), "a_b");
  EXPECT_EQ(next("a;b"), "a_b-2");
  EXPECT_EQ(next("a_b-2"), "a_b-2-2");
  EXPECT_EQ(next("a=b"), "a_b-3");
  EXPECT_EQ(next("..a."), "_.a_");
  EXPECT_EQ(next("b "), "b_");
}

}  // namespace
}  // namespace hyperex::scene
