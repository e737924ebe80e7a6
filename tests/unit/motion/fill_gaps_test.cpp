// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/fill_gaps.hpp"

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
using testing::nan;

Motion with_gap(int first, int last, const std::function<double(double)>& f) {
  Motion motion = testing::sampled(20, 0.1, {"still", "moving"}, [&](double t, int p, int axis) {
    return p == 0 ? 0 : f(t) + axis;
  });
  for (int k = first; k <= last; ++k) motion.positions[std::size_t(k)].row(1).setConstant(nan);
  return motion;
}

TEST(FillGaps, LinearIsExactOnLinesAndReportsWhatItFilled) {
  const auto line = [](double t) { return 3 * t - 1; };
  const FilledMotion filled = fill_gaps(with_gap(5, 7, line), {0.45, GapFill::linear});
  for (int k = 0; k < 20; ++k)
    EXPECT_NEAR(filled.motion.positions[std::size_t(k)](1, 2), line(k * 0.1) + 2, 1e-12);
  ASSERT_EQ(filled.gaps.size(), 1u);
  EXPECT_EQ(filled.gaps[0].point, "moving");
  EXPECT_EQ(filled.gaps[0].samples, 3);
  EXPECT_NEAR(filled.gaps[0].from_s, 0.5, 1e-12);
  EXPECT_NEAR(filled.gaps[0].to_s, 0.7, 1e-12);
}

TEST(FillGaps, CubicFollowsACurveCloserThanLinear) {
  const auto curve = [](double t) { return std::sin(3 * t); };
  double error[2] = {0, 0};
  for (const GapFill how : {GapFill::linear, GapFill::cubic}) {
    const FilledMotion filled = fill_gaps(with_gap(4, 6, curve), {0.5, how});
    for (int k = 4; k <= 6; ++k)
      error[int(how)] =
          std::max(error[int(how)],
                   std::abs(filled.motion.positions[std::size_t(k)](1, 0) - curve(k * 0.1)));
  }
  EXPECT_GT(error[0], 0.1);
  EXPECT_LT(error[1], 0.3 * error[0]);
}

TEST(FillGaps, EndsAreHeld) {
  const auto line = [](double t) { return t; };
  EXPECT_NEAR(fill_gaps(with_gap(0, 1, line)).motion.positions[0](1, 0), 0.2, 1e-12);
  EXPECT_NEAR(fill_gaps(with_gap(18, 19, line)).motion.positions[19](1, 0), 1.7, 1e-12);
}

TEST(FillGaps, NothingToFillChangesNothing) {
  const Motion motion = with_gap(1, 0, [](double t) { return t; });
  const FilledMotion filled = fill_gaps(motion);
  EXPECT_TRUE(filled.gaps.empty());
  EXPECT_EQ(filled.motion.positions[7], motion.positions[7]);
}

TEST(FillGaps, LongGapsAreRefusedByPointStartAndLength) {
  const auto line = [](double t) { return t; };
  testing::expect_refused(
      [&] {
        fill_gaps(with_gap(5, 7, line), {0.3, GapFill::linear});
      },
      {"moving", "0.5 s", "0.4 s", "0.3 s"});
  testing::expect_refused([&] { fill_gaps(with_gap(0, 3, line)); }, {"moving", "from 0 s"});
  testing::expect_refused([&] { fill_gaps(with_gap(16, 19, line)); }, {"moving", "1.6 s"});
  testing::expect_refused([&] { fill_gaps(with_gap(0, 19, line)); },
                          {"moving", "no sample at all"});
}

TEST(FillGaps, HolesInTheSamplesAreGapsToo) {
  Motion motion = with_gap(1, 0, [](double t) { return t; });
  for (std::size_t k = 10; k < motion.time_s.size(); ++k) motion.time_s[k] += 2;
  testing::expect_refused([&] { fill_gaps(motion); }, {"0.9 s", "2.1 s"});
  Motion slow = testing::sampled(4, 1.0, {"a"}, [](double t, int, int) { return t; });
  EXPECT_NO_THROW(fill_gaps(slow));  // slow throughout is no gap
}

}  // namespace
}  // namespace hyperex::motion
