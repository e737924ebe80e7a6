// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/estimate/words.hpp"

#include <gmock/gmock.h>

namespace hyperex::estimate {
namespace {
using testing::StartsWith;

std::string said(Finding::Kind kind, const std::string& name, const Range& interval,
                 bool determined) {
  Estimate estimate;
  Finding finding;
  finding.kind = kind;
  finding.name = name;
  finding.value = 0.5 * (interval.low + interval.high);
  finding.interval = interval;
  finding.determined = determined;
  finding.parts.push_back({.words = "noise", .share = 1});
  estimate.findings.push_back(finding);
  estimate.recordings.resize(1);
  return sentences(estimate).at(0);
}

TEST(EstimateWords, AWideIntervalThatExcludesOneTellsTheSide) {
  using enum Finding::Kind;
  EXPECT_THAT(
      said(gain, "zygomatic_L", {0, 0.94}, false),
      StartsWith("zygomatic_L: acts less strongly than its counterpart, but by how much cannot "
                 "be determined (95 %: 0.00 to 0.94). Largest part"));
  EXPECT_THAT(said(gain, "zygomatic_L", {0, 1.04}, false),
              StartsWith("zygomatic_L: this recording cannot tell (95 %: 0.00 to 1.04)."));
  EXPECT_THAT(
      said(ratio, "cheek_L / cheek_R", {1.2, 9}, false),
      StartsWith("cheek_L / cheek_R: cheek_L is stiffer than cheek_R is, but by how much cannot be "
                 "determined (95 %: 1.20 to 9.00)."));
  EXPECT_THAT(said(young, "young", {4, 60}, false),
              StartsWith("young: this recording cannot tell"));
  EXPECT_THAT(said(gain, "zygomatic_L", {0.2, 0.6}, true),
              StartsWith("zygomatic_L: 0.40 (95 %: 0.20 to 0.60): acts less strongly"));
}

}  // namespace
}  // namespace hyperex::estimate
