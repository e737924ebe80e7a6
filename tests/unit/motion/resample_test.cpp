// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/resample.hpp"

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

/// A motion that starts and ends at rest: (1 - cos 2 pi t) / 2 on [0, 1].
double swing(double t) {
  return (1 - std::cos(2 * M_PI * t)) / 2;
}

Motion swinging(int samples) {
  return testing::sampled(samples, 1.0 / (samples - 1), {"a"},
                          [](double t, int, int axis) { return swing(t) * (axis + 1); });
}

double largest_error(int samples, Interpolation interpolation) {
  const MotionCurve curve(swinging(samples), interpolation);
  double largest = 0;
  for (double t = 0; t <= 1; t += 0.001)
    largest = std::max(largest, std::abs(curve.at(t)(0, 0) - swing(t)));
  return largest;
}

TEST(Resample, AllMeetTheSamplesAndHoldTheEnds) {
  const Motion motion = swinging(11);
  for (const auto how : {Interpolation::linear, Interpolation::cubic}) {
    const MotionCurve curve(motion, how);
    for (std::size_t k = 0; k < motion.time_s.size(); ++k)
      EXPECT_LT((curve.at(motion.time_s[k]) - motion.positions[k]).norm(), 1e-12);
    EXPECT_EQ(curve.at(-0.1), motion.positions.front());
    EXPECT_EQ(curve.at(9), motion.positions.back());
  }
}

TEST(Resample, OrdersOfConvergenceAreTwoAndFour) {
  const auto order = [](Interpolation how) {
    return std::log2(largest_error(21, how) / largest_error(41, how));
  };
  EXPECT_NEAR(order(Interpolation::linear), 2, 0.1);
  EXPECT_NEAR(order(Interpolation::cubic), 4, 0.2);
}

TEST(Resample, CubicHasNoJumpOfVelocityNorAcceleration) {
  const MotionCurve curve(swinging(11), Interpolation::cubic);
  const double h = 1e-4;
  const auto velocity = [&](double t) {
    return (curve.at(t + h / 2)(0, 0) - curve.at(t - h / 2)(0, 0)) / h;
  };
  const auto acceleration = [&](double t) {
    return (curve.at(t + h)(0, 0) - 2 * curve.at(t)(0, 0) + curve.at(t - h)(0, 0)) / (h * h);
  };
  for (int k = 1; k < 10; ++k) {
    const double t = 0.1 * k;
    EXPECT_NEAR(velocity(t - 2 * h), velocity(t + 2 * h), 0.02);
    EXPECT_NEAR(acceleration(t - 2 * h), acceleration(t + 2 * h), 0.5);  // of 20
  }
  EXPECT_NEAR(velocity(2 * h), 0, 0.02);  // at rest at both ends
  EXPECT_NEAR(velocity(1 - 2 * h), 0, 0.02);
}

/// Keys as an animator sets them: 0, a hold at 1, and back.
Motion keyed(double smooth_up_to_s) {
  const std::vector<double> value = {0, 0, 1, 1, 0, 0};
  Motion motion = testing::sampled(
      6, 1, {"a"}, [&](double t, int, int) { return value[std::size_t(std::lround(t))]; });
  motion.time_s = {0, 0.2, 0.3, 1.3, 1.5, 2};
  motion.smooth_up_to_s = smooth_up_to_s;
  return motion;
}

Motion motion_with(Motion motion, double smooth_up_to_s) {
  motion.smooth_up_to_s = smooth_up_to_s;
  return motion;
}

/// Least and greatest value from `from_s` to `to_s`.
std::pair<double, double> range(const Motion& motion, double from_s, double to_s) {
  const MotionCurve curve(motion);
  std::pair<double, double> found(9, -9);
  for (double t = from_s; t <= to_s; t += 0.001) {
    const double y = curve.at(t)(0, 0);
    found = {std::min(found.first, y), std::max(found.second, y)};
  }
  return found;
}

TEST(Resample, BetweenEqualSamplesFarApartThePlaceIsHeld) {
  for (const double smooth_up_to_s : {0.0, Motion::kSmoothUpTo_s}) {
    const auto [held_least, held_most] = range(keyed(smooth_up_to_s), 0.3, 1.3);
    EXPECT_NEAR(held_least, 1, 1e-12) << smooth_up_to_s;
    EXPECT_NEAR(held_most, 1, 1e-12) << smooth_up_to_s;
    const auto [least, most] = range(keyed(smooth_up_to_s), 0, 2);
    EXPECT_GE(least, -1e-15) << smooth_up_to_s;
    EXPECT_LE(most, 1 + 1e-15) << smooth_up_to_s;
  }
  EXPECT_GT(range(keyed(9), 0, 2).second, 1.5) << "the C2 spline overshoots";
}

TEST(Resample, ASampleAtWhichACoordinateTurnsIsItsExtreme) {
  const std::vector<double> value = {0, 0.2, 1, 0.6, 0};
  const Motion motion = testing::sampled(
      5, 0.5, {"a"}, [&](double t, int, int) { return value[std::size_t(std::lround(2 * t))]; });
  EXPECT_GT(range(motion_with(motion, 9), 0, 2).second, 1.001);
  EXPECT_LE(range(motion_with(motion, 0), 0, 2).second, 1 + 1e-12);
}

TEST(Resample, ABoundedSlopeKeepsTheDirectionOfARise) {
  const MotionCurve curve([] {
    Motion motion = testing::sampled(5, 0.5, {"a"}, [](double t, int, int) { return t * t * t; });
    motion.smooth_up_to_s = 0;
    return motion;
  }());
  for (double t = 0.01; t <= 2; t += 0.01)
    EXPECT_GE(curve.at(t)(0, 0), curve.at(t - 0.01)(0, 0)) << t;
  EXPECT_NEAR(curve.at(1.25)(0, 0), 1.70, 0.05) << "not the stairs of slopes that are all 0";
}

/// Of markers only the samples beside a long step are bounded.
TEST(Resample, DenseSamplesOfMarkersKeepTheSpline) {
  Motion motion =
      testing::sampled(6, 0.1, {"a"}, [](double t, int, int) { return t < 0.25 ? 0 : 1; });
  EXPECT_LT(range(motion, 0, 0.5).first, -0.05);
  motion.smooth_up_to_s = 0;
  EXPECT_EQ(range(motion, 0, 0.5).first, 0);
}

TEST(Resample, KeepsNamesAndInterpolatesHeadPose) {
  Motion motion = swinging(3);
  for (int k = 0; k < 3; ++k) {
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.rotate(Eigen::AngleAxisd(0.2 * k, Vec3::UnitY()));
    pose.translation() = Vec3(k, 0, 0);
    motion.head_pose.push_back(pose);
  }
  const Motion finer = resample(motion, {0.25, 0.5, 2}, Interpolation::linear);
  EXPECT_EQ(finer.names, motion.names);
  ASSERT_EQ(finer.head_pose.size(), 3u);
  EXPECT_NEAR(Eigen::AngleAxisd(finer.head_pose[0].linear()).angle(), 0.1, 1e-12);
  EXPECT_NEAR(finer.head_pose[0].translation().x(), 0.5, 1e-12);
  EXPECT_NEAR(finer.head_pose[2].translation().x(), 2, 1e-12);
  EXPECT_NEAR(finer.positions[0](0, 0), 0.5, 1e-12);
}

TEST(Resample, GapsAreRefused) {
  Motion motion = swinging(5);
  motion.positions[2](0, 1) = testing::nan;
  testing::expect_refused([&] { MotionCurve{motion}; }, {"gaps"});
}

}  // namespace
}  // namespace hyperex::motion
