// SPDX-License-Identifier: GPL-3.0-or-later
// The landmarks that blend shapes move: where and which way, after Apple's descriptions of
// ARFaceAnchor.BlendShapeLocation.
#include "hyperex/rig/shape_motion.hpp"

#include <gtest/gtest.h>

#include <set>

#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/blend_shapes.hpp"

namespace hyperex::rig {
namespace {

struct Expected {
  const char *shape, *landmark;
  Vec3 direction;  ///< +x the subject's left, +y up, +z forward
};

const Vec3 kLeft(1, 0, 0), kRight(-1, 0, 0), kUp(0, 1, 0), kDown(0, -1, 0), kForward(0, 0, 1),
    kBack(0, 0, -1);

const std::vector<Expected>& expected() {
  static const std::vector<Expected> rows = {{"browDownLeft", "ibug68_23", kDown},
                                             {"browDownRight", "ibug68_20", kDown},
                                             {"browInnerUp", "ibug68_21", kUp},
                                             {"browOuterUpLeft", "ibug68_25", kUp},
                                             {"browOuterUpRight", "ibug68_18", kUp},
                                             {"cheekPuff", "cheek_L", kForward},
                                             {"cheekSquintLeft", "cheek_L", kUp},
                                             {"cheekSquintRight", "cheek_R", kUp},
                                             {"eyeBlinkLeft", "ibug68_44", kDown},
                                             {"eyeBlinkRight", "ibug68_37", kDown},
                                             {"eyeSquintLeft", "ibug68_46", kUp},
                                             {"eyeSquintRight", "ibug68_41", kUp},
                                             {"eyeWideLeft", "ibug68_44", kUp},
                                             {"eyeWideRight", "ibug68_37", kUp},
                                             {"jawForward", "ibug68_8", kForward},
                                             {"jawLeft", "ibug68_8", kLeft},
                                             {"jawOpen", "ibug68_8", kDown},
                                             {"jawRight", "ibug68_8", kRight},
                                             {"mouthClose", "ibug68_66", kUp},
                                             {"mouthDimpleLeft", "ibug68_54", kBack},
                                             {"mouthDimpleRight", "ibug68_48", kBack},
                                             {"mouthFrownLeft", "ibug68_54", kDown},
                                             {"mouthFrownRight", "ibug68_48", kDown},
                                             {"mouthFunnel", "ibug68_62", kForward},
                                             {"mouthLeft", "ibug68_51", kLeft},
                                             {"mouthLowerDownLeft", "ibug68_56", kDown},
                                             {"mouthLowerDownRight", "ibug68_58", kDown},
                                             {"mouthPressLeft", "ibug68_55", kUp},
                                             {"mouthPressRight", "ibug68_59", kUp},
                                             {"mouthPucker", "ibug68_54", kRight},
                                             {"mouthRight", "ibug68_51", kRight},
                                             {"mouthRollLower", "ibug68_57", kBack},
                                             {"mouthRollUpper", "ibug68_51", kBack},
                                             {"mouthShrugLower", "ibug68_57", kUp},
                                             {"mouthShrugUpper", "ibug68_51", kUp},
                                             {"mouthSmileLeft", "ibug68_54", kUp},
                                             {"mouthSmileRight", "ibug68_48", kUp},
                                             {"mouthStretchLeft", "ibug68_54", kLeft},
                                             {"mouthStretchRight", "ibug68_48", kRight},
                                             {"mouthUpperUpLeft", "ibug68_52", kUp},
                                             {"mouthUpperUpRight", "ibug68_50", kUp},
                                             {"noseSneerLeft", "alare_L", kUp},
                                             {"noseSneerRight", "alare_R", kUp}};
  return rows;
}

Vec3 moved(const std::string& shape, const std::string& landmark) {
  std::vector<Pose> poses = {{.weights = {{shape, 1.0}}}};
  const motion::Motion motion = motion_through(poses);
  const int row = motion.index_of(landmark);
  return (motion.positions[2].row(row) - motion.positions[0].row(row)).transpose();
}

/// The shapes of real faces alone would lift the lower lip over the upper one.
TEST(ShapeMotion, MouthCloseLiftsTheLowerLipAsFarAsJawOpenLowersIt) {
  for (const auto& [upper, lower] : {std::pair{"ibug68_61", "ibug68_67"},
                                     {"ibug68_62", "ibug68_66"},
                                     {"ibug68_63", "ibug68_65"}}) {
    const double opened_m = moved("jawOpen", upper).y() - moved("jawOpen", lower).y();
    EXPECT_GT(opened_m, 0.015) << lower;
    EXPECT_NEAR(moved("mouthClose", lower).y() - moved("mouthClose", upper).y(), opened_m, 1e-5)
        << lower;
  }
}

TEST(ShapeMotion, EachShapeMovesItsPlaceTheRightWay) {
  std::set<std::string> seen;
  for (const Expected& row : expected()) {
    seen.insert(row.shape);
    EXPECT_GT(1e3 * moved(row.shape, row.landmark).dot(row.direction), 0.4)
        << row.shape << " " << 1e3 * moved(row.shape, row.landmark).transpose();
  }
  for (const std::string& shape : expression::arkit_shapes())
    EXPECT_EQ(seen.contains(shape), !shape.starts_with("eyeLook") && shape != "tongueOut") << shape;
}

TEST(ShapeMotion, ASidesShapeLeavesTheOtherSideAlone) {
  for (const Expected& row : expected()) {
    const std::string shape = row.shape;
    if (!shape.ends_with("Left") || shape == "jawLeft" || shape == "mouthLeft") continue;
    std::vector<Pose> poses = {{.weights = {{shape, 1.0}}}};
    const motion::Motion motion = motion_through(poses);
    double left_m = 0, right_m = 0;
    for (Eigen::Index i = 0; i < motion.positions[0].rows(); ++i) {
      const double far_m = (motion.positions[2].row(i) - motion.positions[0].row(i)).norm();
      const double x = motion.positions[0](i, 0);
      if (x > 0) left_m = std::max(left_m, far_m);
      if (x < -0.012) right_m = std::max(right_m, far_m);
    }
    EXPECT_LT(right_m, 0.15 * left_m) << shape;
  }
}

TEST(ShapeMotion, PosesFollowEachOtherFromRest) {
  std::vector<Pose> poses = {{.weights = {{"jawOpen", 1.0}}},
                             {.weights = {{"jawOpen", 0.5}, {"mouthClose", 0.5}}}};
  const motion::Motion motion = motion_through(poses);
  ASSERT_EQ(motion.time_s.size(), 9u) << "rest, and four samples a pose";
  EXPECT_EQ(poses[0].time_s, 0.8);
  EXPECT_EQ(poses[1].time_s, 1.8);
  EXPECT_EQ(motion.positions[4], motion.positions[0]) << "rest between";
  EXPECT_EQ(motion.positions[5], motion.positions[7]) << "held";
  const int chin = motion.index_of("ibug68_8");
  const auto down = [&](std::size_t sample) {
    return motion.positions[0](chin, 1) - motion.positions[sample](chin, 1);
  };
  EXPECT_GT(down(2), 0.01);
  EXPECT_NEAR(down(6), 0.5 * down(2), 0.1 * down(2));
}

}  // namespace
}  // namespace hyperex::rig
