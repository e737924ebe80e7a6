// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/lid_doubts.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "hyperex/face/ibug.hpp"

namespace hyperex::rig {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr double kEye_m = 0.034;  // from the middle of the face

/// A flat skin with the points of both eyes, 28 mm wide. A shape lifts the lower lid by 4 mm.
class LidDoubts : public testing::Test {
 protected:
  LidDoubts() {
    skin_.resize(71 * 41, 3);
    for (int i = 0; i < 71; ++i)
      for (int j = 0; j < 41; ++j) skin_.row(41 * i + j) << 0.002 * (i - 35), 0.002 * (j - 20), 0;
    const double x_mm[] = {-14, -6, 6, 14, 6, -6}, y_mm[] = {0, 5, 5, 0, -5, -5};
    for (int k = 0; k < 6; ++k) {
      landmarks_[face::ibug(36 + k)] = {-kEye_m + 1e-3 * x_mm[k], 1e-3 * y_mm[k], 0};
      landmarks_[face::ibug(42 + k)] = {kEye_m + 1e-3 * x_mm[k], 1e-3 * y_mm[k], 0};
    }
    for (const char* name : {"eyeSquintRight", "eyeSquintLeft", "jawLeft"})
      shapes_.push_back(shape(name));
  }
  report::RigShape shape(const std::string& name) const {
    report::RigShape out{.name = name};
    out.displacement_m = PointsF::Zero(skin_.rows(), 3);
    const double side = name.ends_with("Left") ? kEye_m : -kEye_m;
    for (Eigen::Index v = 0; v < skin_.rows(); ++v) {
      const double off = std::hypot(skin_(v, 0) - side, skin_(v, 1) + 0.005) / 0.012;
      out.displacement_m(v, 1) = float(0.004 * std::exp(-off * off));
    }
    return out;
  }
  /// One vertex of the lower lid of this side moves by so much.
  void lift_one(std::size_t shape, double x, double by_m) {
    Eigen::Index vertex = 0;
    (skin_.rowwise() - Eigen::RowVector3d(x, -0.006, 0)).rowwise().norm().minCoeff(&vertex);
    shapes_[shape].displacement_m(vertex, 1) = float(by_m);
  }
  Points skin_;
  io::Landmarks landmarks_;
  std::vector<report::RigShape> shapes_;
};

TEST_F(LidDoubts, AreNoneOfLidsThatGoWithTheirLandmarks) {
  EXPECT_TRUE(lid_doubts(skin_, landmarks_, shapes_).empty());
  shapes_[2].displacement_m *= 10;
  EXPECT_TRUE(lid_doubts(skin_, landmarks_, shapes_).empty()) << "no shape of a lid";
  shapes_[1].displacement_m.setZero();
  EXPECT_TRUE(lid_doubts(skin_, landmarks_, shapes_).empty()) << "the left eye is closed";
}

TEST_F(LidDoubts, NameAShapeThatMovesALidFartherThanItsLandmarks) {
  for (const std::size_t k : {0, 1}) lift_one(k, k == 0 ? -kEye_m : kEye_m, 0.0125);
  const std::vector<Note> notes = lid_doubts(skin_, landmarks_, shapes_);
  ASSERT_EQ(notes.size(), 2u) << "both eyes, though they are alike";
  EXPECT_EQ(notes[1].id, "rig.lid_doubtful");
  EXPECT_EQ(notes[1].severity, Severity::warning);
  EXPECT_THAT(notes[0].text, HasSubstr("right eye"));
  EXPECT_THAT(notes[1].text, AllOf(HasSubstr("left eye"), HasSubstr("eyeSquintLeft by 12.5 mm"),
                                   HasSubstr("eyeSquintRight by 12.5")));
}

TEST_F(LidDoubts, NameALidThatMovesFartherThanTheOther) {
  shapes_[1].displacement_m *= 2.5;
  const std::vector<Note> notes = lid_doubts(skin_, landmarks_, shapes_);
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_THAT(notes[0].text,
              AllOf(HasSubstr("left eye"), HasSubstr("eyeSquintLeft"), Not(HasSubstr("jawLeft"))));
  shapes_[0].displacement_m.setZero();
  EXPECT_TRUE(lid_doubts(skin_, landmarks_, shapes_).empty()) << "nothing to compare with";
}

/// A weak lid moves less; the healthy one is not torn.
TEST_F(LidDoubts, DoNotCompareSidesWhoseMusclesAreChanged) {
  shapes_[1].displacement_m *= 2.5;
  EXPECT_EQ(lid_doubts(skin_, landmarks_, shapes_, true).size(), 1u);
  EXPECT_TRUE(lid_doubts(skin_, landmarks_, shapes_, false).empty());
  lift_one(1, kEye_m, 0.025);
  EXPECT_EQ(lid_doubts(skin_, landmarks_, shapes_, false).size(), 1u) << "torn all the same";
}

TEST_F(LidDoubts, NeedTheEyes) {
  lift_one(1, kEye_m, 0.0125);
  landmarks_.erase(face::ibug(40));
  EXPECT_TRUE(lid_doubts(skin_, landmarks_, shapes_).empty());
}

}  // namespace
}  // namespace hyperex::rig
