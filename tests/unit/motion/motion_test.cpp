// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/motion.hpp"

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

TEST(Motion, IsLinearBetweenSamplesAndHeldOutside) {
  const Motion motion = testing::sampled(
      3, 0.5, {"a", "b"}, [](double t, int p, int axis) { return t * t * (1 + p) + axis; });
  EXPECT_NEAR(motion.at(0.25)(0, 0), 0.125, 1e-15);  // halfway between 0 and 0.25
  EXPECT_NEAR(motion.at(0.75)(1, 2), 2 * 0.625 + 2, 1e-15);
  EXPECT_EQ(motion.at(0.5), motion.positions[1]);
  EXPECT_EQ(motion.at(-1), motion.positions.front());
  EXPECT_EQ(motion.at(7), motion.positions.back());
}

TEST(Motion, FindsPointsByName) {
  const Motion motion = testing::sampled(1, 1, {"a", "b"}, [](double, int, int) { return 0; });
  EXPECT_EQ(motion.index_of("b"), 1);
  EXPECT_EQ(motion.index_of("c"), -1);
}

}  // namespace
}  // namespace hyperex::motion
