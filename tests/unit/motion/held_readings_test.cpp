// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/held_readings.hpp"

#include <cmath>
#include <random>

#include "hyperex/motion/read_motion.hpp"
#include "hyperex/motion/wild_samples.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

constexpr Eigen::Index kHeld = 4;

/// Nine points 10 mm apart in a plane. They go up and down by `swing_m` once in 2 s.
Motion swinging_sheet(double noise_m, double swing_m = 4e-3) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  return testing::sampled(60, 1 / 30.0, {"p0", "p1", "p2", "p3", "p4", "p5", "p6", "p7", "p8"},
                          [&](double t, int p, int axis) {
                            const double place = axis == 2 ? 0 : 0.01 * (axis ? p / 3 : p % 3);
                            const double up_m =
                                axis == 1 ? swing_m * (1 - std::cos(M_PI * t)) / 2 : 0;
                            return 0.1 + place + up_m + noise_m * normal(random);
                          });
}

/// The middle one is held at its reading `first` up to `last`.
Motion held(Motion motion, std::size_t first, std::size_t last) {
  for (std::size_t k = first + 1; k <= last; ++k)
    motion.positions[k].row(kHeld) = motion.positions[first].row(kHeld);
  return motion;
}

Motion rounded(Motion motion, double digit_m) {
  for (Points& at : motion.positions) at = digit_m * (at.array() / digit_m).round();
  return motion;
}

void expect_held(const Motion& motion, std::size_t first, std::size_t last) {
  const auto found = held_readings(motion);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].point, "p4");
  EXPECT_EQ(found[0].first, first);
  EXPECT_EQ(found[0].last, last);
}

TEST(HeldReadings, AreFoundWhereNoiseNeverRepeats) {
  EXPECT_TRUE(held_readings(swinging_sheet(0.1e-3)).empty());
  expect_held(held(swinging_sheet(0.1e-3), 15, 30), 15, 30);
  expect_held(held(swinging_sheet(0.1e-3), 30, 59), 30, 59);  // to the end
  expect_held(held(swinging_sheet(0.1e-3), 0, 20), 0, 20);    // from the start
}

TEST(HeldReadings, AreFoundWithoutNoiseByTheJumpAtTheirEnd) {
  const Motion still_at_first = [] {
    Motion motion = swinging_sheet(0);
    for (std::size_t k = 0; k < 10; ++k) motion.positions[k] = motion.positions[10];
    return motion;
  }();
  EXPECT_TRUE(held_readings(still_at_first).empty());
  expect_held(held(still_at_first, 12, 30), 12, 30);
}

TEST(HeldReadings, AreAtLeastFiveIn200Milliseconds) {
  EXPECT_TRUE(held_readings(held(swinging_sheet(0.1e-3, 8e-3), 15, 20)).empty());
  expect_held(held(swinging_sheet(0.1e-3, 8e-3), 15, 21), 15, 21);
  Motion slow = swinging_sheet(0.1e-3, 12e-3);
  for (double& t : slow.time_s) t *= 3;
  EXPECT_TRUE(held_readings(held(slow, 20, 23)).empty());
  expect_held(held(slow, 20, 24), 20, 24);
}

TEST(HeldReadings, AreNotThoseOfAPointThatNeverMoves) {
  EXPECT_TRUE(held_readings(held(swinging_sheet(0.1e-3), 0, 59)).empty());
  Motion gap = held(swinging_sheet(0.1e-3), 0, 59);
  gap.positions[30].row(kHeld).setConstant(testing::nan);
  EXPECT_TRUE(held_readings(gap).empty());
}

TEST(HeldReadings, AreNotFoundWhereTheOthersAreStillToo) {
  EXPECT_TRUE(held_readings(held(swinging_sheet(0.1e-3, 0), 15, 45)).empty());
  Motion two_move = held(swinging_sheet(0.1e-3), 15, 30);
  for (const Eigen::Index p : {1, 3})
    for (std::size_t k = 0; k < 60; ++k)
      two_move.positions[k].row(p) = swinging_sheet(0.1e-3, 0).positions[k].row(p);
  EXPECT_TRUE(held_readings(two_move).empty());
}

/// A face that a program made, one of whose points rests while the others move.
TEST(HeldReadings, AreNotThoseOfAPointThatStartsSmoothly) {
  Motion made = swinging_sheet(0);
  const Motion swing = made;
  for (std::size_t k = 0; k < 60; ++k) {
    made.positions[k] = swing.positions[k >= 15 && k <= 45 ? k - 15 : k < 15 ? 0 : 30];
    made.positions[k].row(kHeld) = swing.positions[k <= 40 ? 0 : k - 40].row(kHeld);
  }
  EXPECT_TRUE(held_readings(made).empty());
  for (std::size_t k = 41; k < 60; ++k)  // at once, but at one speed
    made.positions[k].row(kHeld) = swing.positions[0].row(kHeld).array() + 1.5e-3 * double(k - 40);
  EXPECT_TRUE(held_readings(made).empty());
}

TEST(HeldReadings, AreNotThoseOfRoundedReadings) {
  for (const double digit_m : {1e-5, 1e-4, 1e-3})
    EXPECT_TRUE(held_readings(rounded(swinging_sheet(0.1e-3), digit_m)).empty()) << digit_m;
  Motion slower = swinging_sheet(0, 8e-3);  // it moves by a quarter of the others
  for (std::size_t k = 0; k < 60; ++k)
    slower.positions[k].row(kHeld) = swinging_sheet(0, 2e-3).positions[k].row(kHeld);
  EXPECT_TRUE(held_readings(rounded(slower, 1e-3)).empty());
}

TEST(HeldReadings, AreKeptAndNamedAmongTheWrongOnes) {
  const Motion motion = held(swinging_sheet(0.1e-3), 15, 30);
  const MendedMotion kept = without_wild_samples(motion);
  ASSERT_EQ(kept.held.size(), 1u);
  EXPECT_TRUE(kept.motion.positions[25] == motion.positions[25]);
}

TEST(HeldReadings, AreNotInRecordings) {
  for (const char* name : {"subject_A_mouth_open", "subject_A_talk", "subject_A_still"}) {
    const auto folder = testing::recording(name);
    if (folder.empty()) GTEST_SKIP() << "the recordings are not here";
    const Motion motion = read_motion(folder / "truth_landmarks68_camera_m.csv");
    EXPECT_TRUE(held_readings(motion).empty()) << name;
    EXPECT_TRUE(held_readings(rounded(motion, 1e-3)).empty()) << name;
  }
}

}  // namespace
}  // namespace hyperex::motion
