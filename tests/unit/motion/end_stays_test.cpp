// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/end_stays.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/motion/wild_samples.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

/// Nine points 10 mm apart in a plane, which breathe by 1 mm. The fifth is in the middle.
Motion breathing(double rate_hz = 30, int samples = 60, const std::string& middle = "p4") {
  return testing::sampled(samples, 1 / rate_hz,
                          {"p0", "p1", "p2", "p3", middle, "p5", "p6", "p7", "p8"},
                          [](double t, int p, int axis) {
                            const double place = axis == 2 ? 0 : 0.01 * (axis ? p / 3 : p % 3);
                            return 0.1 + place + (axis == 1 ? 1e-3 * std::sin(2 * M_PI * t) : 0);
                          });
}

enum class End { first, last };

/// The middle point is off in the first or the last readings.
Motion away(double off_m, std::size_t count, End end, Motion motion = breathing()) {
  const std::size_t from = end == End::first ? 0 : motion.positions.size() - count;
  for (std::size_t k = from; k < from + count; ++k) motion.positions[k](4, 2) += off_m;
  return motion;
}

void expect_silence(const Motion& motion, const std::string& why) {
  const MendedMotion mended = without_wild_samples(motion);
  EXPECT_TRUE(mended.wild.empty()) << why;
  EXPECT_TRUE(mended.ends.empty()) << why;
  EXPECT_EQ(testing::greatest_difference(mended.motion, motion), 0) << why;
}

TEST(EndStays, FasterThanLipsAndJawAreLeftOut) {
  for (const End end : {End::first, End::last})
    for (const double off_m : {0.0105, 0.012, 0.019, 0.03})
      for (const std::size_t count : {1, 2, 3}) {
        const MendedMotion mended = without_wild_samples(away(off_m, count, end));
        ASSERT_EQ(mended.wild.size(), count) << off_m << " m";
        EXPECT_EQ(mended.wild[0].point, "p4");
        EXPECT_EQ(mended.wild[0].sample, end == End::first ? 0 : 60 - count);
        EXPECT_TRUE(mended.ends.empty());
        EXPECT_TRUE(mended.jumps.empty());
        EXPECT_LT(testing::greatest_difference(mended.motion, breathing()), 0.7e-3)
            << "the nearest one is held";
      }
}

TEST(EndStays, ThatMayBeRealAreNamedAndKept) {
  for (const End end : {End::first, End::last})
    for (const auto& [off_m, count] :
         {std::pair{0.009, std::size_t(1)}, {0.009, std::size_t(3)}, {0.012, std::size_t(5)}}) {
      const Motion motion = away(off_m, count, end);
      const MendedMotion kept = without_wild_samples(motion);
      EXPECT_TRUE(kept.wild.empty());
      EXPECT_EQ(testing::greatest_difference(kept.motion, motion), 0);
      ASSERT_EQ(kept.ends.size(), count) << off_m << " m";
      EXPECT_EQ(kept.ends[0].point, "p4");
      EXPECT_EQ(kept.ends[0].sample, end == End::first ? 0 : 60 - count);
      EXPECT_NEAR(kept.ends[0].off_m, off_m, 1e-4);
    }
}

TEST(EndStays, AreShortAndFar) {
  expect_silence(away(0.0075, 1, End::last), "7.5 mm at 0.23 m/s");
  expect_silence(away(0.012, 7, End::last), "0.23 s");
  EXPECT_EQ(without_wild_samples(away(0.0065, 2, End::last, breathing(60))).wild.size(), 2u);
  EXPECT_EQ(without_wild_samples(away(0.03, 5, End::last)).jumps.size(), 1u);
  EXPECT_TRUE(without_wild_samples(away(0.03, 5, End::last)).ends.empty()) << "named once";
}

TEST(EndStays, MovementsAreNone) {
  Motion joined = away(0.012, 2, End::last);
  for (std::size_t k = 58; k < 60; ++k) joined.positions[k](5, 2) += 0.005;
  expect_silence(joined, "the point beside it moves as well");
  Motion begun = away(0.012, 1, End::last);
  for (std::size_t k = 58; k < 60; ++k) begun.positions[k](4, 2) += 0.005;
  expect_silence(begun, "it moved before");
  Motion going = away(0.012, 2, End::last);
  going.positions[59](4, 2) += 0.005;
  expect_silence(going, "it moves on");
  expect_silence(away(0.012, 2, End::last, breathing(30, 60, "ibug68_37")), "a lid");
  Motion shaking = away(0.012, 1, End::last);
  for (std::size_t k = 0; k < 56; k += 2) shaking.positions[k](4, 2) += 0.0016;
  expect_silence(shaking, "eight times the usual");
}

TEST(EndStays, AWayBackIsNone) {
  const auto back_in_the_last = [](std::size_t count) {
    Motion motion = breathing();
    for (std::size_t k = 59 - count; k < 59; ++k) motion.positions[k](4, 2) += 0.012;
    return without_wild_samples(motion);
  };
  EXPECT_EQ(back_in_the_last(5).wild.size(), 5u) << "a brief stay";
  const MendedMotion longer = back_in_the_last(8);
  EXPECT_EQ(longer.jumps.size(), 2u);
  EXPECT_TRUE(longer.wild.empty());
  EXPECT_TRUE(longer.ends.empty());
  EXPECT_TRUE(back_in_the_last(12).wild.empty());
}

TEST(EndStays, OfSlowRecordingsAreNamedFromTwentyMillimetres) {
  for (const End end : {End::first, End::last}) {
    const Motion motion = away(0.03, 1, end, breathing(6, 7));
    const MendedMotion kept = without_wild_samples(motion);
    ASSERT_EQ(kept.ends.size(), 1u);
    EXPECT_EQ(kept.ends[0].sample, end == End::first ? 0u : 6u);
    EXPECT_EQ(testing::greatest_difference(kept.motion, motion), 0);
    expect_silence(away(0.018, 1, end, breathing(6, 7)), "18 mm");
    expect_silence(away(0.03, 2, end, breathing(6, 7)), "two readings");
  }
}

TEST(EndStays, TheLastReadingIsThatOfThePoint) {
  Motion motion = away(0.012, 2, End::last);
  motion.positions[59].row(4).setConstant(testing::nan);
  const MendedMotion mended = without_wild_samples(motion);
  ASSERT_EQ(mended.wild.size(), 1u);
  EXPECT_EQ(mended.wild[0].sample, 58u);
  EXPECT_TRUE(std::isnan(mended.motion.positions[59](4, 0)));
}

TEST(WildSamples, ALoneReadingIsNamedInAFewSlowOnes) {
  for (const int samples : {5, 6, 7, 9}) {
    Motion motion = breathing(6, samples);
    motion.positions[2](4, 2) += 0.03;
    const MendedMotion kept = without_wild_samples(motion);
    ASSERT_EQ(kept.lone.size(), 1u) << samples;
    EXPECT_EQ(kept.lone[0].sample, 2u);
    EXPECT_TRUE(kept.wild.empty());
    EXPECT_TRUE(kept.ends.empty());
  }
}

/// Some samples of a motion, each `nth` one.
Motion cut(const Motion& whole, std::size_t first, std::size_t count, std::size_t nth) {
  Motion part;
  part.names = whole.names;
  for (std::size_t i = 0; i < count; ++i) {
    part.time_s.push_back(whole.time_s[first + i * nth]);
    part.positions.push_back(whole.positions[first + i * nth]);
  }
  return part;
}

void expect_no_ends(const Motion& whole) {
  constexpr std::size_t samples = 15;
  for (const std::size_t nth : {1, 2, 5})
    for (std::size_t first = 0; first + samples * nth <= whole.positions.size(); first += 5) {
      const MendedMotion mended = without_wild_samples(cut(whole, first, samples, nth));
      const auto at_end = [](const WildSample& one) {
        return one.sample == 0 || one.sample + 1 == samples;
      };
      EXPECT_TRUE(std::ranges::none_of(mended.wild, at_end)) << whole.source << ", " << first;
      EXPECT_TRUE(mended.ends.empty()) << whole.source << ", " << first << ", each of " << nth;
      EXPECT_TRUE(mended.lone.empty()) << whole.source << ", " << first << ", each of " << nth;
    }
}

TEST(EndStays, AreNotWhereRecordingsOfFacesAreCut) {
  const std::vector<Motion> recordings = testing::recordings_of_faces();
  if (recordings.empty()) GTEST_SKIP() << "the shared recordings are not here";
  for (const Motion& recording : recordings) expect_no_ends(recording);
}

}  // namespace
}  // namespace hyperex::motion
