// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/motion/embedded_motion.hpp"

#include "hyperex/motion/stabilise.hpp"
#include "unit/motion/motions.hpp"

namespace hyperex::motion {
namespace {

/// A few landmarks of a face: enough for the jaw's axis and for the head pose.
io::Landmarks some_landmarks() {
  return {{"ibug68_1", {-0.07, 0.015, 0.04}},   {"ibug68_15", {0.07, 0.015, 0.04}},
          {"ibug68_8", {0, -0.08, 0.1}},        {"ibug68_27", {0, 0.035, 0.11}},
          {"ibug68_30", {0, 0.004, 0.13}},      {"ibug68_36", {-0.044, 0.035, 0.085}},
          {"ibug68_45", {0.044, 0.035, 0.085}}, {"ibug68_48", {-0.025, -0.036, 0.1}},
          {"ibug68_51", {0, -0.026, 0.115}},    {"ibug68_57", {0, -0.046, 0.112}}};
}

TEST(EmbeddedMotion, OpensAndClosesOnceFromRestToRest) {
  const Motion motion = embedded_mouth_opening(some_landmarks(), {13, 2.7, 30, false});
  ASSERT_EQ(motion.time_s.size(), 81u);
  EXPECT_NEAR(motion.time_s.back(), 80 / 30.0, 1e-12);
  const int chin = motion.index_of("ibug68_8");
  for (const auto& [name, position] : some_landmarks()) {
    const int p = motion.index_of(name);
    EXPECT_LT((Vec3(motion.positions.front().row(p)) - position).norm(), 1e-12) << name;
    EXPECT_LT((Vec3(motion.positions.back().row(p)) - position).norm(), 1e-12) << name;
  }
  for (std::size_t k = 1; k <= 40; ++k)
    EXPECT_LT(motion.positions[k](chin, 1), motion.positions[k - 1](chin, 1));
  for (std::size_t k = 41; k <= 80; ++k)
    EXPECT_GT(motion.positions[k](chin, 1), motion.positions[k - 1](chin, 1));
}

TEST(EmbeddedMotion, TheJawTurnsByThePeakAngleAndTheUpperFaceIsStill) {
  const io::Landmarks rest = some_landmarks();
  const Motion motion = embedded_mouth_opening(rest, {13, 2.7, 30, false});
  const Points& peak = motion.positions[40];
  const auto turned = [&](const std::string& name) {
    const Vec3 axis_point(0, 0.015, 0.04);  // condyles at the height of 1 and 15
    Vec3 a = rest.at(name) - axis_point, b = Vec3(peak.row(motion.index_of(name))) - axis_point;
    a.x() = b.x() = 0;
    EXPECT_NEAR(a.norm(), b.norm(), 1e-12);
    return std::acos(a.normalized().dot(b.normalized())) * 180 / M_PI;
  };
  EXPECT_NEAR(turned("ibug68_8"), 13, 1e-6);
  EXPECT_NEAR(turned("ibug68_57"), 13, 1e-6);
  EXPECT_NEAR(turned("ibug68_48"), 0.4 * 13, 1e-6);
  EXPECT_NEAR(turned("ibug68_51"), 0, 1e-5);
  EXPECT_LT(peak(motion.index_of("ibug68_8"), 2), rest.at("ibug68_8").z());  // down and back
}

TEST(EmbeddedMotion, StabilisingTakesTheHeadOut) {
  const Motion moving = embedded_mouth_opening(some_landmarks());
  const Motion still = embedded_mouth_opening(some_landmarks(), {13, 2.7, 30, false});
  const StabilisedMotion stable = stabilise(moving);
  double head = 0;
  for (std::size_t k = 0; k < still.positions.size(); ++k) {
    head = std::max(head, (moving.positions[k] - still.positions[k]).rowwise().norm().maxCoeff());
    const double rms = (stable.motion.positions[k] - still.positions[k]).norm() /
                       std::sqrt(double(still.names.size()));
    EXPECT_LT(rms, 2e-4);  // the jaw is no mode of the table to the last
  }
  EXPECT_GT(head, 0.003);
}

TEST(EmbeddedMotion, MissingLandmarksAreNamed) {
  io::Landmarks landmarks = some_landmarks();
  landmarks.erase("ibug68_15");
  testing::expect_refused([&] { embedded_mouth_opening(landmarks); }, {"ibug68_15"});
  testing::expect_refused(
      [] {
        embedded_mouth_opening(some_landmarks(), {-3, 2.7, 30, true});
      },
      {"positive"});
}

}  // namespace
}  // namespace hyperex::motion
