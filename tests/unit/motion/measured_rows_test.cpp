// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/measured_rows.hpp"

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// Twelve samples, 0.1 s apart, of four points on a square; `lost` says which readings are missing.
Motion square(const std::function<bool(int sample, int point)>& lost) {
  return testing::sampled(12, 0.1, {"a", "b", "c", "d"}, [&](double t, int p, int axis) {
    if (lost(int(std::lround(t / 0.1)), p)) return testing::nan;
    return axis == p % 2 ? 0.1 : axis == 2 ? 0.1 * (p / 2) : 0.0;
  });
}

TEST(MeasuredRows, AGapLastsFromReadingToReading) {
  const Motion motion = square([](int k, int p) {
    if (p == 0) return k == 0 || k == 1;
    if (p == 1) return k == 4 || k == 7 || k == 8;
    return p == 2 && k >= 10;
  });
  EXPECT_NEAR(longest_gap_s(motion, 0), 0.2, 1e-12) << "from the start";
  EXPECT_NEAR(longest_gap_s(motion, 1), 0.3, 1e-12);
  EXPECT_NEAR(longest_gap_s(motion, 2), 0.2, 1e-12) << "to the end";
  EXPECT_EQ(longest_gap_s(motion, 3), 0);
  EXPECT_THAT(samples_with_all(motion, {0, 1, 2, 3}), ElementsAre(2u, 3u, 5u, 6u, 9u));
  EXPECT_EQ(longest_gap_s(square([](int, int p) { return p == 0; }), 0),
            std::numeric_limits<double>::infinity());
}

TEST(MeasuredRows, ShortGapsAreFewEnoughWhereHalfOfTheSamplesAreWhole) {
  const auto without = [](int period) {
    return square([=](int k, int p) { return p == 1 && k % period == 1; });
  };
  EXPECT_THAT(hardly_interrupted(without(4), {0, 1, 2}, 0.2), ElementsAre(0, 1, 2));
  EXPECT_THAT(hardly_interrupted(without(4), {0, 1, 2}, 0.15), ElementsAre(0, 2));
  EXPECT_THAT(hardly_interrupted(without(2), {0, 1, 2}, 0.2), ElementsAre(0, 1, 2)) << "half";
  const Motion torn = square([](int k, int p) { return p == 1 && k % 3 != 0; });
  EXPECT_THAT(hardly_interrupted(torn, {0, 1, 2}, 0.3), ElementsAre(0, 2)) << "a third";
  EXPECT_THAT(hardly_interrupted(torn, {1}, 0.3), IsEmpty());
}

TEST(MeasuredRows, OnePointThatFlickersTakesNoToleranceFromTheOthers) {
  const Motion motion = square([](int k, int p) {
    return (p == 1 && k % 3 != 0) || (p == 2 && k == 5) || (p == 3 && k % 4 == 0);
  });
  EXPECT_THAT(hardly_interrupted(motion, {0, 1, 2, 3}, 0.3), ElementsAre(0, 2, 3));
  EXPECT_THAT(hardly_interrupted(motion, {1, 2}, 0.3), ElementsAre(2));
}

TEST(MeasuredRows, ThreePointsOffALineGiveAPoseInAGap) {
  const auto losing = [](int sample, const std::vector<int>& points) {
    return square([=](int k, int p) { return k == sample && std::ranges::count(points, p) > 0; });
  };
  EXPECT_TRUE(give_pose_in_gaps(losing(5, {}), {0, 1}, 0.02)) << "without gaps nothing is asked";
  for (const int sample : {0, 5}) {
    EXPECT_TRUE(give_pose_in_gaps(losing(sample, {1}), {0, 1, 2, 3}, 0.02));
    EXPECT_FALSE(give_pose_in_gaps(losing(sample, {1, 2}), {0, 1, 2, 3}, 0.02));
    EXPECT_FALSE(give_pose_in_gaps(losing(sample, {1}), {0, 1, 2}, 0.02));
  }
}

}  // namespace
}  // namespace hyperex::motion
