// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/words_to_point.hpp"

#include <gtest/gtest.h>

#include "hyperex/face/canonical_face.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/face/point_words.hpp"

namespace hyperex::face {
namespace {

TEST(NameOfWords, KnowsPlainNamesInAnyOrder) {
  for (const auto& [words, name] : {std::pair{"right mouth corner", "ibug68_48"},
                                    {"Mouth_corner_L", "ibug68_54"},
                                    {"R mouth corner", "ibug68_48"},
                                    {"corner of the mouth, right", "ibug68_48"},
                                    {"upper lip", "ibug68_51"},
                                    {"lower lip middle", "ibug68_57"},
                                    {"chin", "ibug68_8"},
                                    {"nose tip", "ibug68_30"},
                                    {"left cheek", "cheek_L"},
                                    {"outer corner of right eye", "ibug68_36"}})
    EXPECT_EQ(name_of_words(words), name) << words;
}

TEST(NameOfWords, GuessesNeitherASideNorOneOfSeveral) {
  for (const char* words : {"", "mouth corner", "lower lip right", "forehead", "nose bridge",
                            "smile", "corner", "right right mouth corner"})
    EXPECT_EQ(name_of_words(words), "") << words;
}

TEST(NameOfWords, OfTheProgramsOwnWordsIsThePoint) {
  for (const std::string& name : all_ibug()) EXPECT_EQ(name_of_words(point_words(name)), name);
}

TEST(MovesWithMouth, TheLipsAndTheChinByAnyOfTheirNames) {
  for (const char* name :
       {"ibug68_4", "ibug68_12", "ibug68_48", "ibug68_67", "48", "p57", "8", "cheilion_L",
        "labiale_superius", "stomion", "pogonion", "lower lip left", "chin", "Mouth_corner_R"})
    EXPECT_TRUE(moves_with_mouth(name)) << name;
  for (const char* name : {"ibug68_3", "ibug68_13", "ibug68_30", "ibug68_47", "36", "p30",
                           "subnasale", "cheek_L", "head_1", "forehead top", "slipper", ""})
    EXPECT_FALSE(moves_with_mouth(name)) << name;
}

}  // namespace
}  // namespace hyperex::face
