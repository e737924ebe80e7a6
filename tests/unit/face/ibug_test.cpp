// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/ibug.hpp"

#include <gtest/gtest.h>

#include <set>

namespace hyperex::face {
namespace {

TEST(Ibug, NamesAreTheSixtyEight) {
  EXPECT_EQ(ibug(48), "ibug68_48");
  EXPECT_EQ(std::set<std::string>(all_ibug().begin(), all_ibug().end()).size(), 68u);
}

TEST(Ibug, NumberIsThatOfTheName) {
  for (int k = 0; k < 68; ++k) EXPECT_EQ(ibug_number(ibug(k)), k);
  for (const char* other : {"", "ibug68_", "ibug68_68", "ibug68_-1", "ibug68_048", "ibug68_4x",
                            "ibug68_48/54", "48", "cheilion_L"})
    EXPECT_FALSE(ibug_number(other)) << other;
}

}  // namespace
}  // namespace hyperex::face
