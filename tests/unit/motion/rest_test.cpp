// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/rest.hpp"

#include <numbers>

#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {
using testing::expect_refused;
using testing::sampled;

const std::vector<std::string> kFacePoints = {"brow", "nose", "right", "left", "chin", "tip"};
const Points kFace = (Points(6, 3) << 0, 0.05, 0.01, 0, 0, 0.03, -0.025, -0.04, 0, 0.025, -0.04, 0,
                      0, -0.08, 0, 0.01, 0.02, 0.02)
                         .finished();

/// Both corners of the mouth move outwards and up by `amplitude_m` times `course(t)`.
Motion smile(const std::function<double(double)>& course, double amplitude_m = 0.01,
             int samples = 61) {
  return sampled(samples, 1.0 / 30, kFacePoints, [&](double t, int p, int axis) {
    const double moved = amplitude_m * course(t);
    if (p == 2 && axis == 0) return kFace(p, axis) - moved;
    if ((p == 3 && axis == 0) || ((p == 2 || p == 3) && axis == 1)) return kFace(p, axis) + moved;
    return kFace(p, axis);
  });
}

double falls(double t) {  // from a full smile to rest within a second, then still
  return t < 1 ? 0.5 * (1 + std::cos(std::numbers::pi * t)) : 0;
}
double rises_and_falls(double t) {
  return 0.5 * (1 - std::cos(std::numbers::pi * t));
}

io::Landmarks at_rest(double off_m) {
  io::Landmarks landmarks;
  for (std::size_t p = 0; p < kFacePoints.size(); ++p) {
    // Another size and pose, and each landmark a little elsewhere than the recorded point.
    const Vec3 wrong(off_m * std::sin(3.0 * double(p)), off_m * std::cos(5.0 * double(p)), 0);
    landmarks[kFacePoints[p]] = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()) *
                                    (1.1 * (kFace.row(Eigen::Index(p)).transpose() + wrong)) +
                                Vec3(1, 2, 3);
  }
  return landmarks;
}

TEST(WithRest, BeginsLaterAndIsLedThereFromRest) {
  const Motion whole = smile(rises_and_falls);
  const RestedMotion later = with_rest(whole, {0, 0}, 0.5);
  EXPECT_EQ(later.lead_s, rest_lead_s);
  EXPECT_NEAR(later.motion.time_s.front(), 0.5 - rest_lead_s, 1e-9);
  EXPECT_EQ(later.motion.time_s.back(), whole.time_s.back());
  EXPECT_LT((later.motion.positions.front() - whole.positions.front()).norm(), 1e-12);
  const auto at =
      std::size_t(std::find(whole.time_s.begin(), whole.time_s.end(), 0.5) - whole.time_s.begin());
  EXPECT_EQ(later.motion.positions[later.motion.positions.size() - whole.positions.size() + at],
            whole.positions[at]);
  EXPECT_EQ(with_rest(whole, {0, 0}, 0).motion.time_s, whole.time_s);
  expect_refused([&] { with_rest(whole, {0, 0}, 2); }, {"time.start_s"});
}

TEST(StartedInExpression, IsSeenWhereTheEndIsNearerToRest) {
  for (const double off_m : {0.0, 0.002}) {
    const auto started = started_in_expression(smile(falls), at_rest(off_m));
    ASSERT_TRUE(started) << off_m;
    EXPECT_GE(started->stretch.from_s, 0.7);
    EXPECT_TRUE(started->point == "right" || started->point == "left");
    EXPECT_NEAR(started->distance_m, 0.011 * std::numbers::sqrt2, 0.004);
  }
}

TEST(StartedInExpression, IsNotSeenWhereAMotionStartsAtRest) {
  for (const double off_m : {0.0, 0.002, 0.004}) {
    EXPECT_FALSE(started_in_expression(smile(rises_and_falls), at_rest(off_m))) << off_m;
    EXPECT_FALSE(
        started_in_expression(smile([](double t) { return 1 - falls(t); }), at_rest(off_m)));
    EXPECT_FALSE(started_in_expression(smile(falls, 0.001), at_rest(off_m)));
  }
  EXPECT_FALSE(started_in_expression(smile(falls, 0.01, 10), at_rest(0)));  // too short to tell
}

/// Goes evenly to its peak within `rise_s` and stays there.
Motion ramp(double rise_s, int samples, double amplitude_m = 0.01) {
  return smile([=](double t) { return std::min(1.0, t / rise_s); }, amplitude_m, samples);
}

TEST(EndedInExpression, IsSeenWhereAMotionBreaksOff) {
  for (const int samples : {20, 22, 24}) {
    const auto ended = ended_in_expression(smile(rises_and_falls, 0.01, samples));
    ASSERT_TRUE(ended) << samples;
    EXPECT_TRUE(ended->point == "right" || ended->point == "left");
    EXPECT_EQ(ended->before_end_s, 0);
    const double at_end = rises_and_falls((samples - 1) / 30.0);
    EXPECT_NEAR(ended->distance_m, 0.01 * std::numbers::sqrt2 * at_end, 1e-9);
  }
  // A last reading that noise puts a little nearer does not hide it.
  Motion nearer = smile(rises_and_falls, 0.01, 20);
  nearer.positions.back() = 0.1 * nearer.positions[17] + 0.9 * nearer.positions[18];
  const auto ended = ended_in_expression(nearer);
  ASSERT_TRUE(ended);
  EXPECT_NEAR(ended->before_end_s, 1.0 / 30, 1e-9);
}

TEST(EndedInExpression, IsNotSeenWhereItIsComplete) {
  EXPECT_FALSE(ended_in_expression(smile(rises_and_falls)));            // back at rest
  EXPECT_FALSE(ended_in_expression(smile(rises_and_falls, 0.01, 31)));  // slow at the peak
  EXPECT_FALSE(ended_in_expression(smile(rises_and_falls, 0.01, 50)));  // on its way back
  EXPECT_FALSE(ended_in_expression(ramp(1, 31)));                       // as those of a rig
  EXPECT_FALSE(ended_in_expression(ramp(0.5, 25)));                     // held for 0.3 s
  // Complete once, and cut in a second one.
  const auto twice = [](double t) { return (t < 1 ? 1 : 0.8) * rises_and_falls(2 * t); };
  EXPECT_FALSE(ended_in_expression(smile(twice, 0.01, 44)));
}

TEST(EndedInExpression, IsNotToldOfTooLittle) {
  EXPECT_TRUE(ended_in_expression(smile(rises_and_falls, 0.01, 19)));
  EXPECT_FALSE(ended_in_expression(smile(rises_and_falls, 0.01, 18)));   // shorter than 0.6 s
  EXPECT_FALSE(ended_in_expression(smile(rises_and_falls, 0.002, 19)));  // 1.9 mm
  Motion coarse = smile(rises_and_falls, 0.01, 19);
  for (double& t : coarse.time_s) t *= 4;
  EXPECT_FALSE(ended_in_expression(coarse));
  Motion lost = smile(rises_and_falls, 0.01, 20);
  for (Points& sample : lost.positions) sample.row(2).setConstant(testing::nan);
  EXPECT_TRUE(ended_in_expression(lost));  // by the other corner
}

TEST(WithRest, LeadsAnExpressionInFromRest) {
  const Motion m = smile(falls);
  const RestedMotion rested = with_rest(m, {1.2, 1.8});
  EXPECT_EQ(rested.lead_s, rest_lead_s);
  const Motion& r = rested.motion;
  EXPECT_NEAR((r.positions.front() - kFace).cwiseAbs().maxCoeff(), 0, 1e-12);
  EXPECT_NEAR(r.time_s.front(), -rest_lead_s, 1e-12);
  for (std::size_t k = 1; k < r.time_s.size(); ++k) EXPECT_GT(r.time_s[k], r.time_s[k - 1]);
  const std::size_t added = r.time_s.size() - m.time_s.size();
  EXPECT_EQ(std::vector<double>(r.time_s.begin() + long(added), r.time_s.end()), m.time_s);
  EXPECT_EQ(r.positions[added], m.positions[0]);
  // Half-way in time is half-way in space, and the ends are slow.
  EXPECT_NEAR(r.at(-rest_lead_s / 2)(3, 0) - kFace(3, 0), 0.005, 3e-4);
  EXPECT_LT((r.positions[1] - r.positions[0]).norm(), 2e-4);
}

TEST(WithRest, TakesTheMeanWhereTheStartIsAtRest) {
  // Noise of 0.2 mm about rest in the first 0.3 s.
  Motion m =
      smile([](double t) { return t < 0.3 ? 0.02 * std::cos(t * 30 * std::numbers::pi) : 1; });
  const RestedMotion rested = with_rest(m, {0, 0.19});
  EXPECT_EQ(rested.lead_s, 0);
  EXPECT_EQ(rested.motion.time_s, m.time_s);
  EXPECT_NEAR((rested.motion.positions.front() - kFace).cwiseAbs().maxCoeff(), 0, 1e-9);
  EXPECT_EQ(rested.motion.positions[1], m.positions[1]);
}

TEST(WithRest, TakesTheNearestSampleOfASingleTime) {
  Motion m = smile(falls);
  for (double& t : m.time_s) t += 1e6;  // seconds since 1970, say
  const RestedMotion rested = with_rest(m, {0.51, 0.51});
  EXPECT_NEAR((rested.motion.positions.front() - m.positions[15]).norm(), 0, 1e-12);
}

TEST(WithRest, RefusesAStretchWithoutMeasurements) {
  Motion m = smile(falls);
  expect_refused([&] { with_rest(m, {1, 7}); }, {"lasts 2.000 s", "7 s"});
  for (std::size_t k = 40; k < 61; ++k) m.positions[k].row(2).setConstant(testing::nan);
  expect_refused([&] { with_rest(m, {1.5, 1.9}); }, {"point right is not measured"});
}

}  // namespace
}  // namespace hyperex::motion
