// SPDX-License-Identifier: GPL-3.0-or-later
// The position of the jaw in each frame of a run.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/drive/jaw.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"
#include "support/estimated_bones.hpp"

namespace hyperex::simulate {
namespace {

class JawCourse : public testing::TestWithParam<DriveBy> {
 protected:
  JawCourse() {
    options_.drive.by = GetParam();
    options_.time.step_s = 0.01;
    options_.time.still_times_s = {0.2};
  }
  SimulationResult run() const { return simulate(face_.mesh, face_.landmarks, motion_, options_); }

  const test::SmallFace face_ = test::small_face();
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 10, 13, 30);
  SimulationOptions options_;
};

TEST_P(JawCourse, CarriesTheChinAsItWasRecorded) {
  const SimulationResult result = run();
  const auto& p = result.performance;
  ASSERT_EQ(p.jaw_now_from_rest.size(), p.frame_time_s.size());
  EXPECT_LT((p.jaw_now_from_rest[0].matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-9);
  const PointCurve points(motion_, 1);
  const int row = motion_.motion.index_of(face::ibug(8));
  const Vec3 chin = motion_.rest.row(row);
  double widest = 0;
  for (std::size_t f = 0; f < p.frame_time_s.size(); ++f) {
    const Eigen::Isometry3d& jaw = p.jaw_now_from_rest[f];
    EXPECT_LT((jaw.linear() * jaw.linear().transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-12);
    const Vec3 wanted = points.at(p.frame_time_s[f]).row(row);
    // The jaw has its own priors: three quarters of a millimetre at 10 degrees.
    EXPECT_LT((jaw * chin - chin - wanted).norm(), 1e-3) << f;
    widest = std::max(widest, Eigen::AngleAxisd(jaw.linear()).angle());
  }
  EXPECT_NEAR(widest, result.report.greatest_opening_deg * M_PI / 180, 0.02);
  EXPECT_GT(widest, 0.08) << "the jaw turns more than it slides";
}

TEST_P(JawCourse, IsKnownAtStillsToo) {
  const SimulationResult result = run();
  ASSERT_EQ(result.still_jaw_now_from_rest.size(), 1u);
  // 0.2 s is the time of frame 6.
  EXPECT_LT((result.still_jaw_now_from_rest[0].matrix() -
             result.performance.jaw_now_from_rest[6].matrix())
                .norm(),
            1e-9);
}

TEST_P(JawCourse, AHeldJawStays) {
  options_.support.mandible = Mandible::held;
  for (const Eigen::Isometry3d& jaw : run().performance.jaw_now_from_rest)
    EXPECT_EQ(jaw.matrix(), Eigen::Matrix4d::Identity());
}

INSTANTIATE_TEST_SUITE_P(Drives, JawCourse,
                         testing::Values(DriveBy::displacement, DriveBy::muscles,
                                         DriveBy::reactions));

TEST(JawOfAMeasuredFace, IsTheChinsWhereAllIsMeasured) {
  const test::SmallFace face = test::small_face();
  const AlignedMotion motion = test::mouth_opening(face.landmarks, 10, 13, 30);
  SimulationOptions options;
  options.region.measured = Measured::all;
  const SimulationResult result = simulate(face.mesh, face.landmarks, motion, options);
  EXPECT_GT(Eigen::AngleAxisd(result.performance.jaw_now_from_rest[6].linear()).angle(), 0.12);
}

class JawOfOwnBones : public testing::TestWithParam<double> {
 protected:
  JawOfOwnBones() {
    options_.drive.by = DriveBy::muscles;
    options_.drive.points = test::seven_points();
    const Vec3 half = 0.05 * estimated_.frame.x;
    mesh_.bones = std::make_shared<const anatomy::Bones>(
        hyperex::test::estimated_bone(face_.mesh, face_.landmarks, Bone::skull),
        hyperex::test::estimated_bone(face_.mesh, face_.landmarks, Bone::mandible),
        anatomy::Condyles{heads_ + half, heads_ - half});
  }
  const test::SmallFace face_ = test::small_face();
  const JawHinge estimated_{face_.landmarks, nullptr};
  const Vec3 heads_ = estimated_.centre - GetParam() * estimated_.frame.z;
  tissue::TissueMesh mesh_ = face_.mesh;
  SimulationOptions options_;
};

TEST_P(JawOfOwnBones, TakesTheDrivenPointsWhereTheyAreDriven) {
  const AlignedMotion motion = test::mouth_opening(face_.landmarks, 10, 13, 30);
  const SimulationResult result = simulate(mesh_, face_.landmarks, motion, options_);
  EXPECT_GT(result.report.greatest_opening_deg, 5);
  EXPECT_LT(result.report.driven_off_mm, 0.5);
}

/// The lower lip and the chin turn about the heads of the mandible, where these are.
TEST_P(JawOfOwnBones, TurnsAboutItsOwnHeads) {
  const JawHinge own(face_.landmarks, mesh_.bones.get());
  const AlignedMotion motion = test::motion_of(
      face_.landmarks, 9, 30, [&](const std::string& name, const Vec3& x, int k) -> Vec3 {
        if (name != face::ibug(8) && name != face::ibug(57) && name != face::ibug(56) &&
            name != face::ibug(58))
          return Vec3::Zero();
        return own.turned(0.02 * k, 0) * (x - own.centre) + own.centre - x;
      });
  const SimulationResult result = simulate(mesh_, face_.landmarks, motion, options_);
  const Eigen::Isometry3d& jaw =
      result.performance.jaw_now_from_rest[std::size_t(result.performance.peak_frame)];
  const double angle = Eigen::AngleAxisd(jaw.linear()).angle();
  EXPECT_GT(angle, 0.1);
  // The heads may slide: MuscleOptions::slide_sigma_m.
  EXPECT_LT((jaw * heads_ - heads_).norm(), GetParam() > 0 ? 0.0012 : 0.0035);
}

INSTANTIATE_TEST_SUITE_P(FartherBack, JawOfOwnBones, testing::Values(0.0, 0.025),
                         [](const auto& c) { return c.param > 0 ? "by_25_mm" : "as_estimated"; });

}  // namespace
}  // namespace hyperex::simulate
