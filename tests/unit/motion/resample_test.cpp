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
  for (const auto how : {Interpolation::linear, Interpolation::cubic, Interpolation::monotone}) {
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

TEST(Resample, MonotoneNeverOvershoots) {
  const Motion step =
      testing::sampled(6, 1, {"a"}, [](double t, int, int) { return t < 2.5 ? 0 : 1; });
  double cubic_low = 0, monotone_low = 0;
  const MotionCurve cubic(step, Interpolation::cubic), monotone(step, Interpolation::monotone);
  for (double t = 0; t <= 5; t += 0.01) {
    cubic_low = std::min(cubic_low, cubic.at(t)(0, 0));
    monotone_low = std::min(monotone_low, monotone.at(t)(0, 0));
    EXPECT_LE(monotone.at(t)(0, 0), 1 + 1e-15);
  }
  EXPECT_EQ(monotone_low, 0);
  EXPECT_LT(cubic_low, -0.05);
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
