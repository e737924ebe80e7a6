// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/wild_samples.hpp"

#include <cmath>
#include <functional>

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

constexpr double kStep_s = 1.0 / 30;

/// Four points. The last one opens by 20 mm and closes within a second, while the head moves.
Motion opening(double step_s = kStep_s, double head_m_s = 0.1) {
  return testing::sampled(31, step_s, {"a", "b", "c", "lip"}, [&](double t, int p, int axis) {
    const double moved = p == 3 && axis == 1 ? 0.02 * std::pow(std::sin(M_PI * t), 2) : 0;
    return 0.03 * p * (axis + 1) + moved + (axis == 0 ? head_m_s * t : 0);
  });
}

Motion with_jump(double off_m, std::size_t first, std::size_t last, double step_s = kStep_s) {
  Motion motion = opening(step_s);
  for (std::size_t k = first; k <= last; ++k) motion.positions[k](3, 2) += off_m;
  return motion;
}

TEST(WildSamples, SoundMotionStaysAsItIs) {
  const MendedMotion mended = without_wild_samples(opening());
  EXPECT_TRUE(mended.wild.empty());
  EXPECT_EQ(testing::greatest_difference(mended.motion, opening()), 0);
}

TEST(WildSamples, AJumpOfOneOrTwoReadingsIsInterpolated) {
  for (const std::size_t last : {10, 11}) {
    const MendedMotion mended = without_wild_samples(with_jump(0.3, 10, last));
    ASSERT_EQ(mended.wild.size(), last - 9);
    EXPECT_EQ(mended.wild[0].point, "lip");
    EXPECT_EQ(mended.wild[0].sample, 10u);
    EXPECT_NEAR(mended.wild[0].off_m, 0.3, 2e-3);
    EXPECT_LT(testing::greatest_difference(mended.motion, opening()), 1e-3);
  }
}

TEST(WildSamples, TheFirstAndTheLastReadingAreHeld) {
  for (const std::size_t at : {0, 30}) {
    const MendedMotion mended = without_wild_samples(with_jump(0.3, at, at));
    ASSERT_EQ(mended.wild.size(), 1u);
    EXPECT_EQ(mended.wild[0].sample, at);
    EXPECT_LT(testing::greatest_difference(mended.motion, opening()), 5e-3);
  }
}

TEST(WildSamples, WhatStaysAwayIsKeptAndNamedOnTheWayThereAndBack) {
  const Motion motion = with_jump(0.03, 10, 15);
  const MendedMotion mended = without_wild_samples(motion);
  EXPECT_TRUE(mended.wild.empty());
  EXPECT_EQ(testing::greatest_difference(mended.motion, motion), 0);
  ASSERT_EQ(mended.jumps.size(), 2u);
  EXPECT_EQ(mended.jumps[0].point, "lip");
  EXPECT_EQ(mended.jumps[0].sample, 10u);
  EXPECT_EQ(mended.jumps[1].sample, 16u);
  EXPECT_NEAR(mended.jumps[0].off_m, 0.03, 1e-3);
  EXPECT_EQ(without_wild_samples(with_jump(0.03, 10, 30)).jumps.size(), 1u);
}

TEST(WildSamples, JumpsAreFasterThanAFaceAcrossGapsToo) {
  Motion motion = with_jump(0.03, 10, 30);
  motion.positions[9].row(3).setConstant(testing::nan);
  EXPECT_TRUE(without_wild_samples(motion).jumps.empty()) << "30 mm in two steps";
  EXPECT_TRUE(without_wild_samples(with_jump(0.018, 10, 14)).jumps.empty());
  EXPECT_TRUE(without_wild_samples(with_jump(0.05, 10, 14, 0.1)).jumps.empty());
  EXPECT_FALSE(without_wild_samples(with_jump(0.07, 10, 14, 0.1)).jumps.empty());
}

TEST(WildSamples, ShortRecordingsAreSearchedForJumps) {
  Motion motion = with_jump(0.3, 2, 2);
  motion.time_s.resize(4);
  motion.positions.resize(4);
  const MendedMotion mended = without_wild_samples(motion);
  EXPECT_TRUE(mended.wild.empty());
  EXPECT_EQ(mended.jumps.size(), 2u);
}

TEST(WildSamples, SoundAndMendedReadingsAreNoJumps) {
  EXPECT_TRUE(without_wild_samples(opening()).jumps.empty());
  EXPECT_TRUE(without_wild_samples(with_jump(0.3, 10, 11)).jumps.empty());
}

TEST(WildSamples, TheHeadMayJump) {
  Motion motion = opening();
  motion.positions[10].col(0).array() += 0.05;
  EXPECT_TRUE(without_wild_samples(motion).wild.empty());
  EXPECT_TRUE(without_wild_samples(motion).jumps.empty());
}

TEST(WildSamples, SlowRecordingsMayMoveFartherInASampleAndAreNamed) {
  EXPECT_EQ(without_wild_samples(with_jump(0.025, 10, 10)).wild.size(), 1u);
  const Motion slow = with_jump(0.055, 10, 10, 0.1);
  const MendedMotion kept = without_wild_samples(slow);
  EXPECT_TRUE(kept.wild.empty());
  EXPECT_EQ(testing::greatest_difference(kept.motion, slow), 0);
  ASSERT_EQ(kept.lone.size(), 1u);
  EXPECT_EQ(kept.lone[0].point, "lip");
  EXPECT_EQ(kept.lone[0].sample, 10u);
  EXPECT_NEAR(kept.lone[0].off_m, 0.055, 1e-3);
  EXPECT_TRUE(without_wild_samples(with_jump(0.055, 10, 11, 0.1)).lone.empty());
  EXPECT_EQ(without_wild_samples(with_jump(0.1, 10, 10, 0.1)).wild.size(), 1u);
}

/// Points on a grid of 10 mm which all breathe by 1 mm. Point p4 is in the middle.
Motion grid(const std::function<double(double t, int p)>& moved_m) {
  return testing::sampled(31, kStep_s, {"p0", "p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"},
                          [&](double t, int p, int axis) {
                            const double place = axis == 2 ? 0 : 0.01 * (axis ? p / 3 : p % 3);
                            const double breath = axis == 1 ? 1e-3 * std::sin(2 * M_PI * t) : 0;
                            return 0.1 + place + breath + (axis == 2 ? moved_m(t, p) : 0);
                          });
}

bool is_sample(double t, int k) {
  return std::abs(t - k * kStep_s) < 1e-6;
}

TEST(WildSamples, ALoneReadingIsWildFromSixMillimetres) {
  const Motion sound = grid([](double, int) { return 0.0; });
  const auto with_lone = [](double off_m) {
    return grid([&](double t, int p) { return p == 4 && is_sample(t, 12) ? off_m : 0; });
  };
  const MendedMotion mended = without_wild_samples(with_lone(0.007));
  ASSERT_EQ(mended.wild.size(), 1u);
  EXPECT_EQ(mended.wild[0].point, "p4");
  EXPECT_EQ(mended.wild[0].sample, 12u);
  EXPECT_NEAR(mended.wild[0].off_m, 0.007, 2e-4);
  EXPECT_LT(testing::greatest_difference(mended.motion, sound), 1e-4);
  EXPECT_TRUE(without_wild_samples(with_lone(0.0055)).wild.empty());
}

TEST(WildSamples, WhatOtherPointsDoTooIsNoLoneReading) {
  // Of a lid, two points move.
  EXPECT_TRUE(without_wild_samples(grid([](double t, int p) {
                return (p == 4 || p == 5) && is_sample(t, 12) ? 0.01 : 0;
              })).wild.empty());
  // A movement that rises and falls.
  EXPECT_TRUE(without_wild_samples(grid([](double t, int p) {
                if (p != 4) return 0.0;
                return is_sample(t, 12) ? 0.016 : is_sample(t, 11) || is_sample(t, 13) ? 0.008 : 0;
              })).wild.empty());
}

TEST(WildSamples, WhereAPointAlwaysShakesALoneReadingIsNothing) {
  const auto shaking = [](double t, int p) {
    const int k = int(std::lround(t / kStep_s));
    return p == 4 && k % 4 == 1 ? 0.007 : 0.0;
  };
  EXPECT_TRUE(without_wild_samples(grid(shaking)).wild.empty());
}

TEST(WildSamples, ReadingsAtTheOriginAreMissing) {
  Motion motion = opening();
  motion.positions[10].row(3).setZero();
  motion.positions[11].row(3).setZero();
  const MendedMotion mended = without_wild_samples(motion);
  ASSERT_EQ(mended.zeros.size(), 2u);
  EXPECT_EQ(mended.zeros[0].point, "lip");
  EXPECT_EQ(mended.zeros[1].sample, 11u);
  EXPECT_TRUE(mended.wild.empty());
  EXPECT_TRUE(std::isnan(mended.motion.positions[10](3, 0)));
  // Points that begin at the origin, and one that is always there.
  EXPECT_TRUE(without_wild_samples(opening()).zeros.empty());
}

TEST(WildSamples, GapsStayGaps) {
  Motion motion = with_jump(0.3, 10, 10);
  motion.positions[12].row(3).setConstant(testing::nan);
  const MendedMotion mended = without_wild_samples(motion);
  ASSERT_EQ(mended.wild.size(), 1u);
  EXPECT_TRUE(std::isnan(mended.motion.positions[12](3, 0)));
  EXPECT_TRUE(mended.motion.positions[10].allFinite());
}

TEST(WildSamples, WhatNoFaceCanReachIsRefusedByLinePointTimeAndDistance) {
  Motion motion = with_jump(0.151, 10, 30);
  motion.source = "markers.csv";
  for (int k = 0; k < 31; ++k) motion.lines.push_back(k + 2);
  testing::expect_refused([&] { check_reach(motion); },
                          {"markers.csv:12", "point lip at 0.333 s", "155", "150 mm"});
  EXPECT_NO_THROW(check_reach(with_jump(0.1, 10, 30)));
}

TEST(WildSamples, MillimetresInTheMemoryAreTakenForMetres) {
  Motion motion = with_jump(0.151, 10, 30);
  testing::expect_refused([&] { check_reach(motion); }, {"correct the reading"});
  for (Points& at : motion.positions) at *= 1e3;
  testing::expect_refused([&] { check_reach(motion); }, {"seem to be in millimetres"});
  motion.unit_note = "m";
  testing::expect_refused([&] { check_reach(motion); }, {"correct the reading"});
}

TEST(WildSamples, AHeadMayGoFarAndTurn) {
  Motion walking = opening(kStep_s, 1);
  EXPECT_NO_THROW(check_reach_beside_head(walking)) << "by 1 m";
  EXPECT_NO_THROW(check_reach_beside_head(with_jump(0.2, 10, 30)));
  for (std::size_t k = 10; k < 31; ++k) walking.positions[k](3, 2) += 0.26;
  testing::expect_refused([&] { check_reach_beside_head(walking); },
                          {"point lip at 0.333 s", "250 mm"});
}

TEST(WildSamples, APointThatIsMeasuredLaterIsJudgedByItsFirstReading) {
  Motion motion = with_jump(0.2, 10, 30);
  motion.positions[0].row(3).setConstant(testing::nan);
  testing::expect_refused([&] { check_reach(motion); }, {"point lip at 0.333 s"});
}

}  // namespace
}  // namespace hyperex::motion
