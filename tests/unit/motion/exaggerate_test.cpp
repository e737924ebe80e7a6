// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/exaggerate.hpp"

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
using testing::expect_refused;
using testing::nan;

Motion three_points() {
  return testing::sampled(4, 0.1, {"a", "b", "c"}, [](double t, int point, int axis) {
    return 0.1 * point + 0.02 * axis + t * (point + 1) * 0.01;
  });
}

TEST(PointGains, MultiplyTheDisplacementOfTheNamedPointAlone) {
  const Motion motion = three_points(), out = with_point_gains(motion, {{"b", 1.5}, {"c", 0}});
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_EQ(out.positions[k].row(0), motion.positions[k].row(0));
    const double t = 0.1 * double(k);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(out.positions[k](1, axis), 0.1 + 0.02 * axis + 1.5 * t * 0.02, 1e-15);
      EXPECT_EQ(out.positions[k](2, axis), motion.positions[0](2, axis));
    }
  }
  EXPECT_EQ(out.time_s, motion.time_s);
}

TEST(PointGains, RefuseWhatCannotBe) {
  Motion motion = three_points();
  expect_refused([&] { with_point_gains(motion, {{"z", 1}}); }, {"z"});
  expect_refused([&] { with_point_gains(motion, {{"a", 1}, {"a", 2}}); }, {"a has two gains"});
  expect_refused([&] { with_point_gains(motion, {{"a", -1}}); }, {"a", "-1"});
  expect_refused([&] { with_point_gains(motion, {{"a", nan}}); }, {"a", "nan"});
  motion.positions[2].row(0).setConstant(nan);
  EXPECT_TRUE(std::isnan(with_point_gains(motion, {{"a", 2}}).positions[2](0, 0)));
  motion.positions[0].row(0).setConstant(nan);
  expect_refused([&] { with_point_gains(motion, {{"a", 2}}); }, {"a", "first sample"});
}

TEST(TimeScale, SlowsFromTheFirstSampleOn) {
  Motion motion = three_points();
  for (double& t : motion.time_s) t += 7;
  const Motion out = time_scaled(motion, 2);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(out.time_s[std::size_t(k)], 7 + 0.2 * k, 1e-12);
  EXPECT_EQ(out.positions[3], motion.positions[3]);
  EXPECT_EQ(out.smooth_up_to_s, 2 * motion.smooth_up_to_s) << "slow motion takes the same course";
  expect_refused([&] { time_scaled(motion, 0); }, {"above 0"});
  expect_refused([&] { time_scaled(motion, nan); }, {"above 0"});
}

}  // namespace
}  // namespace hyperex::motion
