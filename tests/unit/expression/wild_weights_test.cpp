// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/wild_weights.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <functional>
#include <limits>

#include "unit/io/io_testing.hpp"

namespace hyperex::expression {
namespace {
using testing::EndsWith;
using testing::HasSubstr;
using WildWeightsFile = io::testing::FileTest;

/// One weight at equal steps.
BlendShapes one_weight(const std::string& name, const std::vector<double>& weights,
                       double rate_hz = 60) {
  BlendShapes shapes;
  shapes.names = {name};
  shapes.weights.resize(Eigen::Index(weights.size()), 1);
  for (std::size_t k = 0; k < weights.size(); ++k) {
    shapes.time_s.push_back(double(k) / rate_hz);
    shapes.weights(Eigen::Index(k), 0) = weights[k];
  }
  return shapes;
}

/// 30 readings that rise from 0 to 0.29, and some in their place.
std::vector<double> rising(std::size_t from, const std::vector<double>& instead) {
  std::vector<double> weights;
  for (int k = 0; k < 30; ++k) weights.push_back(0.01 * k);
  std::ranges::copy(instead, weights.begin() + std::ptrdiff_t(from));
  return weights;
}

double largest_change(const MendedShapes& mended, const std::vector<double>& from) {
  double most = 0;
  for (std::size_t k = 0; k < from.size(); ++k)
    if (std::isfinite(from[k]))
      most = std::max(most, std::abs(mended.shapes.weights(Eigen::Index(k), 0) - from[k]));
  return most;
}

/// What is found among weights that stay as they are.
std::size_t doubts_of(const std::vector<double>& weights, double rate_hz = 60,
                      const std::string& name = "mouthSmileLeft") {
  const MendedShapes mended = without_wild_weights(one_weight(name, weights, rate_hz));
  EXPECT_TRUE(mended.wild.empty());
  EXPECT_EQ(largest_change(mended, weights), 0);
  return mended.doubtful.size();
}

TEST(WildWeights, ASpikeOfOneReadingIsInterpolated) {
  for (const double spike : {1.0, 0.52}) {
    const MendedShapes mended = without_wild_weights(one_weight("jawOpen", rising(20, {spike})));
    ASSERT_EQ(mended.wild.size(), 1u);
    EXPECT_EQ(mended.wild[0].sample, 20u);
    EXPECT_EQ(mended.wild[0].shape, 0u);
    EXPECT_NEAR(mended.wild[0].off, spike - 0.21, 1e-12) << "the median of the five";
    EXPECT_TRUE(mended.doubtful.empty());
    EXPECT_LT(largest_change(mended, rising(0, {})), 1e-12);
  }
  EXPECT_EQ(doubts_of(rising(20, {0.5})), 0u) << "a jump of 0.29";
}

TEST(WildWeights, ADropOfOneReadingIsInterpolated) {
  std::vector<double> held(20, 0.8);
  held[7] = 0;
  const MendedShapes mended = without_wild_weights(one_weight("mouthPucker", held));
  ASSERT_EQ(mended.wild.size(), 1u);
  EXPECT_NEAR(mended.wild[0].off, -0.8, 1e-12);
  EXPECT_LT(largest_change(mended, std::vector<double>(20, 0.8)), 1e-12);
}

TEST(WildWeights, SeveralReadingsAtAWrongWeightAreInterpolated) {
  for (const std::size_t count : {2, 3, 5, 8})
    for (const double wrong : {0.55, 1.0}) {
      const MendedShapes mended = without_wild_weights(
          one_weight("jawOpen", rising(15, std::vector<double>(count, wrong))));
      ASSERT_EQ(mended.wild.size(), count) << wrong;
      EXPECT_EQ(mended.wild[0].sample, 15u);
      EXPECT_NEAR(mended.wild[0].off, wrong - 0.15, 1e-12) << "the line through those beside it";
      EXPECT_TRUE(mended.doubtful.empty());
      EXPECT_LT(largest_change(mended, rising(0, {})), 1e-12);
    }
  EXPECT_EQ(doubts_of(rising(15, {0.44, 0.44})), 0u) << "a jump of 0.3, but 0.28 back";
}

TEST(WildWeights, WrongWeightsForLongerAreKeptAndNamed) {
  const std::vector<double> held(7, 0.9);
  EXPECT_EQ(doubts_of(rising(10, held), 30), 7u) << "0.27 s";
  EXPECT_EQ(doubts_of(rising(10, std::vector<double>(9, 0.9)), 30), 0u) << "0.33 s";
  EXPECT_EQ(doubts_of(rising(10, {1, 1}), 20), 0u) << "a face may be that fast";
}

TEST(WildWeights, MovementsAreKept) {
  EXPECT_EQ(doubts_of(rising(20, {0.5, 1, 0.5})), 0u) << "up and down";
  EXPECT_EQ(doubts_of(rising(20, {1, 0.5, 1})), 0u) << "up, and another movement there";
  EXPECT_EQ(doubts_of(rising(20, {0.65, 0.65, 0.8, 1})), 0u) << "farther back than away";
  EXPECT_EQ(doubts_of(rising(20, {1, 0.6})), 0u) << "fast up, slower down";
  EXPECT_EQ(doubts_of({0, 0, 0, 0, 1, 1, 1, 1}), 0u) << "a step";
  EXPECT_EQ(doubts_of({0, 0, 0, 0, 0.5, 1, 1, 1}), 0u) << "a ramp";
}

TEST(WildWeights, EyesLidsAndTongueAreThatFast) {
  for (const char* name :
       {"eyeBlinkLeft", "eyeSquintRight", "eyeWideLeft", "eyeLookUpRight", "tongueOut"}) {
    EXPECT_EQ(doubts_of(rising(20, {1}), 60, name), 0u) << name;
    EXPECT_EQ(doubts_of(rising(20, {1, 1, 1}), 60, name), 0u) << name;
  }
}

TEST(WildWeights, TheFirstAndTheLastReadingAreKeptAndNamed) {
  for (const std::size_t at : {0, 29}) {
    const MendedShapes mended = without_wild_weights(one_weight("jawOpen", rising(at, {1})));
    ASSERT_EQ(mended.doubtful.size(), 1u);
    EXPECT_EQ(mended.doubtful[0].sample, at);
    EXPECT_TRUE(mended.wild.empty());
    EXPECT_EQ(mended.shapes.weights(Eigen::Index(at), 0), 1);
  }
  EXPECT_EQ(doubts_of({1, 0.8, 0.5, 0.2, 0, 0, 0}), 0u) << "on its way back";
  EXPECT_EQ(without_wild_weights(one_weight("jawOpen", rising(28, {1}))).wild.size(), 1u)
      << "the last but one";
}

TEST(WildWeights, SlowRecordingsKeepTheReadingAndMayJumpFarther) {
  EXPECT_EQ(without_wild_weights(one_weight("jawOpen", rising(20, {1}), 23.976)).wild.size(), 1u);
  EXPECT_EQ(doubts_of(rising(20, {1}), 20), 1u);
  EXPECT_EQ(doubts_of(rising(20, {0.9}), 10), 0u) << "a jump of 0.69 within 0.1 s";
  EXPECT_EQ(doubts_of(rising(20, {0.95}), 10), 1u) << "of 0.74";
  EXPECT_EQ(doubts_of(rising(20, {1}), 5), 0u);
}

TEST(WildWeights, EmptyCellsArePassedOver) {
  const double empty = std::numeric_limits<double>::quiet_NaN();
  const MendedShapes mended = without_wild_weights(one_weight("jawOpen", rising(20, {1, empty})));
  EXPECT_EQ(mended.wild.size(), 1u);
  EXPECT_NEAR(mended.shapes.weights(20, 0), 0.2, 1e-12) << "between readings 19 and 22, in time";
  EXPECT_TRUE(std::isnan(mended.shapes.weights(21, 0)));
  EXPECT_EQ(doubts_of(rising(20, {1, empty}), 30), 1u) << "the reading after is 67 ms away";
  EXPECT_EQ(doubts_of({0, 0, 1, 0}), 0u) << "fewer than five readings";
  EXPECT_EQ(doubts_of({0, 0, 1, 0, empty, empty}), 0u);
}

TEST_F(WildWeightsFile, AreNamedByLineColumnTimeAndJump) {
  std::string text = "# of a phone\ntime_s,JawOpen,mouthSmileLeft\n";
  for (int k = 0; k < 40; ++k)
    text += fmt::format("{},{},{}\n", k * 0.02, k % 8 == 4 ? 0.75 : 0, k == 39 ? 1 : 0.25);
  const MendedShapes mended = without_wild_weights(read_arkit(write("w.csv", text)));
  const std::string wild = wild_weights_sentence(mended);
  EXPECT_THAT(wild, HasSubstr("5 such readings"));
  EXPECT_THAT(wild, HasSubstr("w.csv:7, JawOpen at 0.080 s: by +0.75; "));
  EXPECT_THAT(wild, HasSubstr("w.csv:23, JawOpen at 0.400 s: by +0.75; and 2 more"));
  const std::string doubtful = doubtful_weights_sentence(mended);
  EXPECT_THAT(doubtful, HasSubstr("1 such reading "));
  EXPECT_THAT(doubtful, EndsWith("w.csv:42, mouthSmileLeft at 0.780 s: by +0.75"));
  const MendedShapes sound = without_wild_weights(one_weight("jawOpen", rising(0, {})));
  EXPECT_EQ(wild_weights_sentence(sound) + doubtful_weights_sentence(sound), "");
}

TEST_F(WildWeightsFile, OfAnActionUnitCountOnceForBothSides) {
  std::string text = "timestamp, success, AU12_r, AU10_r, AU25_r\n";
  for (int k = 0; k < 12; ++k)
    text += fmt::format("{}, 1, {}, {}, 0\n", k * 0.04, k == 5 ? 5 : 1, k == 8 ? 5 : 0);
  const MendedShapes mended = without_wild_weights(read_openface(write("o.csv", text)));
  EXPECT_EQ(mended.wild.size(), 4u);
  const std::string wild = wild_weights_sentence(mended);
  EXPECT_THAT(wild, HasSubstr("2 such readings"));
  EXPECT_THAT(wild, HasSubstr("o.csv:7, AU12_r at 0.200 s: by +0.80; "));
  EXPECT_THAT(wild, EndsWith("o.csv:10, AU10_r and AU25_r at 0.320 s: by +1.00"));
}

/// Every `nth` sample of a recording.
BlendShapes thinned(const BlendShapes& shapes, Eigen::Index nth, Eigen::Index from) {
  BlendShapes out = shapes;
  out.time_s.clear();
  out.lines.clear();
  const Eigen::Index count = (shapes.weights.rows() - from + nth - 1) / nth;
  out.weights.resize(count, shapes.weights.cols());
  for (Eigen::Index k = 0; k < count; ++k) {
    out.time_s.push_back(shapes.time_s[std::size_t(from + k * nth)]);
    out.weights.row(k) = shapes.weights.row(from + k * nth);
  }
  return out;
}

TEST(WildWeights, AreNotInRecordingsOfPeople) {
  const std::filesystem::path data = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  const auto phone = data / "real/livelink/range_of_motion.csv",
             pictures = data / "motion/openface_au_19_3.csv";
  if (!std::filesystem::exists(phone) || !std::filesystem::exists(pictures))
    GTEST_SKIP() << "no shared data at " << data;
  const BlendShapes take = read_arkit(phone);
  for (const Eigen::Index nth : {1, 2, 3, 4, 6})
    for (Eigen::Index from = 0; from < nth; ++from) {
      const MendedShapes mended = without_wild_weights(thinned(take, nth, from));
      EXPECT_EQ(wild_weights_sentence(mended), "");
      EXPECT_EQ(doubtful_weights_sentence(mended), "") << "each sample of " << nth;
    }
  const MendedShapes mended = without_wild_weights(read_openface(pictures));
  EXPECT_EQ(wild_weights_sentence(mended) + doubtful_weights_sentence(mended), "");
}

}  // namespace
}  // namespace hyperex::expression
