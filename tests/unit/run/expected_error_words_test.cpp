// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/run/expected_error_words.hpp"

#include <gtest/gtest.h>

namespace hyperex::run {
namespace {
using Json = nlohmann::ordered_json;

TEST(ExpectedErrorWords, EachShareIsBesideItsRegion) {
  const Json summary{{"uncertainty",
                      {{"face", {{"distance_rms_mm", 3.0}, {"determined", 0.5}}},
                       {"cheeks", {{"distance_rms_mm", 3.94}, {"determined", 0.437}}},
                       {"lips", {{"distance_rms_mm", 2.04}, {"determined", 0.92}}}}}};
  EXPECT_EQ(expected_error_line(summary),
            "expected error of the skin between the driven points: lips 2.0 mm, cheeks 3.9 mm\n"
            "  how much of its motion (variance) the recording shows: lips 92 %, cheeks 44 %; the "
            "rest is how faces usually move\n");
  EXPECT_EQ(expected_error_line(Json::object()), "");
  EXPECT_EQ(expected_error_line({{"uncertainty", Json::object()}}), "");
}

}  // namespace
}  // namespace hyperex::run
