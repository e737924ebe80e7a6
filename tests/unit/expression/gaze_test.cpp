// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/expression/gaze.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>

#include "hyperex/expression/arkit_names.hpp"
#include "hyperex/expression/blend_shapes.hpp"
#include "unit/io/io_testing.hpp"

namespace hyperex::expression {
namespace {

using GazeFile = io::testing::FileTest;
using testing::DoubleNear;
using testing::ElementsAre;
using testing::Pointwise;

constexpr double kDegree = std::numbers::pi / 180;

/// Yaw and pitch of the right, then of the left eye.
auto are_degrees(const std::array<double, 4>& degrees) {
  return Pointwise(testing::DoubleNear(1e-9), degrees);
}

/// The gaze of one sample with these weights.
EyesGaze of_weights(std::vector<std::string> names, std::vector<double> weights) {
  BlendShapes shapes;
  shapes.time_s = {0};
  shapes.names = std::move(names);
  shapes.weights = Eigen::Map<Eigen::RowVectorXd>(weights.data(), Eigen::Index(weights.size()));
  return gaze_of(shapes).value().gaze.front();
}

TEST(Gaze, OfALookToTheLeftTurnsBothEyesToTheLeft) {
  // A face that looks along +z with its left at +x.
  const EyesGaze gaze = of_weights({"eyeLookOutLeft", "eyeLookInRight"}, {1, 0.5});
  EXPECT_THAT(degrees_of(gaze), are_degrees({0.5 * kLookAside_deg, 0, kLookAside_deg, 0}));
  const Vec3 left = turn_of(gaze.left, Vec3::UnitZ(), Vec3::UnitX()) * Vec3::UnitZ();
  EXPECT_NEAR(left.x(), std::sin(kLookAside_deg * kDegree), 1e-12) << "the subject's left";
  EXPECT_NEAR(left.y(), 0, 1e-12);
  EXPECT_GT((turn_of(gaze.right, Vec3::UnitZ(), Vec3::UnitX()) * Vec3::UnitZ()).x(), 0.2);
}

TEST(Gaze, OfALookToTheRightTurnsBothEyesToTheRight) {
  EXPECT_THAT(degrees_of(of_weights({"eyeLookOutRight", "eyeLookInLeft"}, {1, 1})),
              are_degrees({-kLookAside_deg, 0, -kLookAside_deg, 0}));
}

TEST(Gaze, GoesUpAndDown) {
  const EyesGaze up = of_weights({"eyeLookUpLeft", "eyeLookUpRight"}, {1, 0.5});
  EXPECT_THAT(degrees_of(up), are_degrees({0, 0.5 * kLookUp_deg, 0, kLookUp_deg}));
  EXPECT_GT((turn_of(up.left, Vec3::UnitZ(), Vec3::UnitX()) * Vec3::UnitZ()).y(), 0.4);
  EXPECT_THAT(degrees_of(of_weights({"eyeLookDownLeft"}, {1})),
              are_degrees({0, 0, 0, -kLookDown_deg}));
}

TEST(Gaze, TurnsAboutTheFacesOwnAxes) {
  // A face that looks along +x, with its left at -z and somewhat forward of the right.
  const Vec3 ahead = Vec3::UnitX(), across(0.01, 0, -0.06);
  const Vec3 up = turn_of({.up_rad = 0.3}, ahead, across) * ahead;
  EXPECT_NEAR((up - Vec3(std::cos(0.3), std::sin(0.3), 0)).norm(), 0, 1e-12);
  const Vec3 both = turn_of({.up_rad = 0.3, .left_rad = 0.2}, ahead, across) * ahead;
  EXPECT_NEAR(both.y(), std::sin(0.3), 1e-12) << "a turn aside keeps the height";
  EXPECT_NEAR(std::atan2(-both.z(), both.x()), 0.2, 1e-12);
}

TEST(Gaze, HasAnAngleForEachShapeThatLooks) {
  int count = 0;
  for (const std::string& shape : arkit_shapes()) {
    EXPECT_EQ(gaze_of_shape(shape).has_value(), is_gaze(shape)) << shape;
    count += is_gaze(shape);
  }
  EXPECT_EQ(count, 8);
}

TEST_F(GazeFile, AnglesOfLiveLinkCountMoreThanItsWeights) {
  // As recorded: the left eye looks out at a negative yaw, and down at a positive pitch.
  const BlendShapes shapes = read_arkit(
      write("l.csv",
            "Timecode,EyeLookOutLeft,JawOpen,LeftEyeYaw,LeftEyePitch,LeftEyeRoll,RightEyeYaw,"
            "RightEyePitch\n00:00:00:00.000,0.9,0,-0.5,0.25,0.1,-0.4,0.2\n"
            "00:00:01:00.000,0.9,0,0,0,0,0,0\n"));
  ASSERT_EQ(shapes.notes.size(), 2u);
  EXPECT_EQ(shapes.notes[1], "columns left out: LeftEyeRoll");
  const std::optional<GazeTrack> track = gaze_of(shapes);
  ASSERT_TRUE(track);
  EXPECT_THAT(track->time_s, ElementsAre(0, 1));
  EXPECT_THAT(degrees_of(track->gaze[0]),
              are_degrees({0.4 / kDegree, -0.2 / kDegree, 0.5 / kDegree, -0.25 / kDegree}));
}

TEST_F(GazeFile, AnglesInDegreesAreLeftOutWithANote) {
  const BlendShapes shapes =
      read_arkit(write("d.csv",
                       "time_s,jawOpen,LeftEyeYaw,LeftEyePitch,RightEyeYaw,RightEyePitch\n"
                       "0,0,0,0,0,0\n1,1,20,0,20,0\n"));
  EXPECT_THAT(shapes.notes, testing::Contains(testing::HasSubstr("reach 20, so they are no")));
  EXPECT_FALSE(gaze_of(shapes));
}

TEST_F(GazeFile, IsAbsentWhereNothingWasMeasured) {
  EXPECT_FALSE(gaze_of(read_arkit(write("a.csv", "time_s,jawOpen\n0,0\n1,1\n"))));
  // As this program's own tracker writes it.
  EXPECT_FALSE(gaze_of(read_arkit(
      write("b.csv",
            "time_s,jawOpen,eyeLookUpLeft,LeftEyeYaw,LeftEyePitch,RightEyeYaw,RightEyePitch\n"
            "0,0,0,0,0,0,0\n1,1,0,0,0,0,0\n"))));
}

TEST(GazeTrack, IsLinearBetweenSamplesAndHeldAtItsEnds) {
  const GazeTrack track{{1, 2}, {{}, {.right = {.up_rad = 0.1}, .left = {.left_rad = -0.2}}}};
  EXPECT_EQ(track.at(0).left.left_rad, 0);
  EXPECT_NEAR(track.at(1.25).left.left_rad, -0.05, 1e-12);
  EXPECT_NEAR(track.at(1.25).right.up_rad, 0.025, 1e-12);
  EXPECT_EQ(track.at(2).left.left_rad, -0.2);
  EXPECT_EQ(track.at(9).left.left_rad, -0.2);
}

TEST(GazeTrack, IsLedInFromLookingAhead) {
  const GazeTrack track{{1, 2, 3},
                        {{.right = {}, .left = {.left_rad = -0.4}},
                         {.right = {.up_rad = 0.1}, .left = {.left_rad = -0.2}},
                         {.right = {}, .left = {.left_rad = 0.6}}}};
  const GazeTrack led = led_in(track, 2.5, 0.5);
  EXPECT_EQ(led.time_s.front(), 2);
  EXPECT_TRUE(std::ranges::is_sorted(led.time_s, std::less_equal<>()));
  EXPECT_EQ(led.at(2).left.left_rad, 0);
  EXPECT_EQ(led.at(2).right.up_rad, 0);
  EXPECT_NEAR(led.at(2.1).left.left_rad, 0.05792 * 0.2, 1e-9) << "10 u^3 - 15 u^4 + 6 u^5 at 0.2";
  EXPECT_NEAR(led.at(2.25).right.up_rad, 0.5 * 0.05, 1e-9);
  for (const double t_s : {2.5, 2.75, 3.0, 9.0})
    EXPECT_NEAR(led.at(t_s).left.left_rad, track.at(t_s).left.left_rad, 1e-12) << t_s;
}

TEST(GazeTrack, LeavesOutSamplesWithoutAValue) {
  BlendShapes shapes;
  shapes.time_s = {0, 1, 2};
  shapes.names = {"eyeLookUpLeft"};
  shapes.weights.resize(3, 1);
  shapes.weights << 0, std::numeric_limits<double>::quiet_NaN(), 1;
  EXPECT_THAT(gaze_of(shapes).value().time_s, ElementsAre(0, 2));
}

/// What the angles at weight 1 are taken from.
TEST(GazeTrack, OfWeightsAgreesWithTheAnglesOfARealTake) {
  const auto file =
      std::filesystem::path(HYPEREX_SHARED_DIR) / "data/real/livelink/range_of_motion.csv";
  if (!std::filesystem::exists(file)) GTEST_SKIP() << file << " is not there";
  BlendShapes shapes = read_arkit(file);
  const GazeTrack angles = gaze_of(shapes).value();
  shapes.eye_angles_rad.resize(0, 0);
  const GazeTrack weights = gaze_of(shapes).value();
  ASSERT_EQ(angles.time_s.size(), weights.time_s.size());
  std::array<double, 4> mean{}, most{};
  const double share = 1 / double(angles.time_s.size());
  const auto off = [&](std::size_t k, std::size_t c) {
    return degrees_of(weights.gaze[k])[c] - degrees_of(angles.gaze[k])[c];
  };
  for (std::size_t k = 0; k < angles.time_s.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c) mean[c] += share * off(k, c);
  for (std::size_t k = 0; k < angles.time_s.size(); ++k)
    for (std::size_t c = 0; c < 4; ++c) most[c] = std::max(most[c], std::abs(off(k, c) - mean[c]));
  EXPECT_THAT(mean, ElementsAre(DoubleNear(3.7, 0.2), DoubleNear(0, 0.2), DoubleNear(-3.7, 0.2),
                                DoubleNear(0, 0.2)))
      << "with weights of 0 each eye points outwards";
  for (const double one : most) EXPECT_LT(one, 2.5);
}

/// The upper edge of the iris (0.51 rad from its middle) on an eyeball of 10.6 mm radius.
double iris_top_mm(double up_deg) {
  return 10.6 * std::sin(0.51 + up_deg * std::numbers::pi / 180);
}

/// Displacement of a lid's point (y, mm) under weights of one sample.
double lid_moved_mm(const std::vector<std::string>& names, const std::vector<double>& weights,
                    const char* point) {
  BlendShapes shapes;
  shapes.names = names;
  shapes.time_s = {0, 1};
  shapes.weights = Eigen::MatrixXd::Zero(2, Eigen::Index(names.size()));
  for (std::size_t c = 0; c < names.size(); ++c) shapes.weights(1, Eigen::Index(c)) = weights[c];
  std::vector<std::string> notes;
  const motion::Motion motion = motion_of(shapes, canonical_model(), notes);
  const int row = motion.index_of(point);
  return 1e3 * (motion.positions[1](row, 1) - motion.positions[0](row, 1));
}

TEST(Lids, CoverOneToTwoMillimetresOfTheIrisUpAndDown) {
  constexpr double rest_mm = 3.0;  // of the upper lid above the eyeball's middle
  for (const double weight : {0.25, 0.5, 0.75, 1.0}) {
    const double down_mm = rest_mm + lid_moved_mm({"eyeLookDownLeft"}, {weight}, "ibug68_43");
    EXPECT_NEAR(iris_top_mm(-weight * kLookDown_deg) - down_mm, 1.5, 0.7) << weight;
    const double up_mm = rest_mm + lid_moved_mm({"eyeLookUpLeft"}, {weight}, "ibug68_43");
    EXPECT_NEAR(iris_top_mm(weight * kLookUp_deg) - up_mm, 1.8, 0.7) << weight;
  }
  EXPECT_LT(lid_moved_mm({"eyeLookDownLeft"}, {1}, "ibug68_47"), -2) << "the lower lid goes along";
  EXPECT_NEAR(lid_moved_mm({"eyeLookDownLeft"}, {1}, "ibug68_37"), 0, 1e-9) << "the other eye";
}

TEST(Lids, MoveOnceWhereBlinkAndWideContainTheGaze) {
  const auto lid_mm = [](const char* gaze, double w, const char* lids, double v) {
    return lid_moved_mm({gaze, lids}, {w, v}, "ibug68_43");
  };
  const double down_mm = lid_mm("eyeLookDownLeft", 0.5, "eyeBlinkLeft", 0);
  EXPECT_NEAR(lid_mm("eyeLookDownLeft", 0.5, "eyeBlinkLeft", 0.3), down_mm, 0.1);
  EXPECT_NEAR(lid_mm("eyeLookDownLeft", 0.5, "eyeBlinkLeft", 1),
              lid_mm("eyeLookDownLeft", 0, "eyeBlinkLeft", 1), 1e-9)
      << "a blink closes the eye wherever it looks";
  const double up_mm = lid_mm("eyeLookUpLeft", 0.5, "eyeWideLeft", 0);
  EXPECT_NEAR(lid_mm("eyeLookUpLeft", 0.5, "eyeWideLeft", 0.5), up_mm, 0.1);
}

TEST(Lids, WithoutAMeasurementStayWithout) {
  BlendShapes shapes;
  shapes.names = {"eyeLookDownLeft", "eyeBlinkLeft"};
  shapes.time_s = {0};
  shapes.weights = Eigen::MatrixXd::Constant(1, 2, std::nan(""));
  EXPECT_TRUE(std::isnan(with_lids_once(shapes).weights(0, 0)));
}

}  // namespace
}  // namespace hyperex::expression
