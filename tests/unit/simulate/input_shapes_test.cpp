// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/input_shapes.hpp"

#include <gtest/gtest.h>

#include "hyperex/motion/resample.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kDt = 0.004;
constexpr int kSteps = 110;  // 0.44 s: past the last sample, at 0.4 s

class InputShapesOf : public testing::Test {
 protected:
  InputShapesOf() { options_.drive.points = test::seven_points(); }

  Boundary boundary(const AlignedMotion& motion) const {
    return Boundary(face_.mesh, face_.landmarks, motion,
                    measured_region(face_.mesh, face_.landmarks, motion, options_.region),
                    options_.drive, options_.support);
  }
  static std::function<Points(double)> way(const AlignedMotion& motion) {
    return [curve = motion::MotionCurve(motion.motion), rest = motion.rest](double t) {
      return Points(curve.at(t) - rest);
    };
  }
  /// Greatest lack in any value and any force over all steps, each over its greatest.
  std::pair<double, double> lacks(const AlignedMotion& motion, double tolerance, int* rank) const {
    Boundary shaped = boundary(motion), direct = boundary(motion);
    const auto at = way(motion);
    const InputShapes shapes = input_shapes(shaped, at, kDt, kSteps, tolerance);
    const fem::Drive& drive = shapes.drive;
    EXPECT_EQ(drive.steps(), kSteps);
    if (rank) *rank = static_cast<int>(drive.shapes());
    Eigen::VectorXd values(direct.prescribed().size()), force(3 * direct.node_count());
    double value = 0, value_lack = 0, pull = 0, pull_lack = 0, opening = 0;
    for (int k = 0; k <= kSteps; ++k) {
      const Points d = at(k * kDt);
      direct.prescribe(d, direct.follow(d), values, force);
      opening = std::max(opening, direct.jaw_opening_deg());
      value = std::max(value, values.cwiseAbs().maxCoeff());
      pull = std::max(pull, force.cwiseAbs().maxCoeff());
      value_lack = std::max(value_lack, (drive.prescribed_at(k).d - values).cwiseAbs().maxCoeff());
      pull_lack = std::max(pull_lack, (drive.force_at(k) - force).cwiseAbs().maxCoeff());
    }
    EXPECT_GT(value, 0.005);
    EXPECT_DOUBLE_EQ(shapes.greatest_opening_deg, opening);
    return {value_lack / value, pull > 0 ? pull_lack / pull : 0};
  }

  const test::SmallFace face_ = test::small_face();
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 12, 13, 30);
  SimulationOptions options_;
};

// The input's numbers are met to the tolerance. Values and forces combine them with weights whose
// sums are near one, and rotations act with levers near 0.1 m.
constexpr double kMixing = 5;

TEST_F(InputShapesOf, GiveWhatTheBoundaryPrescribesAtAllSteps) {
  int before = 0;
  for (const double tolerance : {1e-2, 1e-4, 1e-6}) {
    int rank = 0;
    const auto [values, forces] = lacks(motion_, tolerance, &rank);
    EXPECT_LT(values, kMixing * tolerance);
    EXPECT_LT(forces, kMixing * tolerance);
    EXPECT_GE(rank, before);
    before = rank;
  }
}

TEST_F(InputShapesOf, GiveMeasuredRegionsAndEverySupport) {
  options_.region.measured = Measured::points;
  options_.region.measured_points = {"ibug68_8", "ibug68_48"};
  options_.region.measured_radius_m = 0.02;
  for (const Mandible mandible : {Mandible::follow, Mandible::held, Mandible::free})
    for (const double foundation : {0.0, 5e6}) {
      options_.support.mandible = mandible;
      options_.support.field_pa_per_m = foundation;
      const auto [values, forces] = lacks(motion_, 1e-5, nullptr);
      EXPECT_LT(values, kMixing * 1e-5);
      EXPECT_LT(forces, kMixing * 1e-5);
    }
}

TEST_F(InputShapesOf, AreFewForARigidMotionAndNoneForNone) {
  // Everything goes one way: one direction, whatever its course.
  options_.support.mandible = Mandible::free;
  const auto shifted = test::motion_of(face_.landmarks, 13, 30, [](auto&, auto&, int k) {
    return Vec3(Vec3(0.006, -0.008, 0.003) * std::pow(std::sin(0.26 * k), 2));
  });
  int rank = 0;
  EXPECT_LT(lacks(shifted, 1e-6, &rank).first, 1e-5);
  EXPECT_EQ(rank, 1);
  // A jaw's turn by an angle is a cosine and a sine of it: two directions, some more for the fit of
  // the jaw, which is not linear.
  options_.support.mandible = Mandible::follow;
  lacks(motion_, 1e-3, &rank);
  EXPECT_GE(rank, 2);
  EXPECT_LE(rank, 5);
  const auto still =
      test::motion_of(face_.landmarks, 13, 30, [](auto&, auto&, int) { return Vec3::Zero(); });
  Boundary b = boundary(still);
  const InputShapes none = input_shapes(b, way(still), kDt, kSteps, 1e-3);
  EXPECT_EQ(none.drive.shapes(), 0);
  EXPECT_EQ(none.drive.prescribed_at(5).d.norm(), 0);
  EXPECT_EQ(none.drive.force_at(5).norm(), 0);
}

/// The derivatives belong to one function: the integrals of the cubic between steps are exactly the
/// differences of its values.
TEST_F(InputShapesOf, DerivativesAreThoseOfASplineThroughTheValues) {
  Boundary b = boundary(motion_);
  const fem::Drive drive = input_shapes(b, way(motion_), kDt, kSteps, 1e-6).drive;
  ASSERT_GT(drive.shapes(), 0);
  const double s = drive.s.cwiseAbs().maxCoeff(), rate = drive.rate.cwiseAbs().maxCoeff(),
               second = drive.second.cwiseAbs().maxCoeff();
  EXPECT_EQ(drive.rate.col(0).norm(), 0) << "at rest at the start";
  EXPECT_LT(drive.s.col(0).norm(), 1e-12 * s);
  for (int k = 0; k < kSteps; ++k) {
    const Eigen::VectorXd a = drive.second.col(k), a1 = drive.second.col(k + 1);
    const Eigen::VectorXd by_rate = drive.rate.col(k + 1) - drive.rate.col(k);
    EXPECT_LT((by_rate - kDt / 2 * (a + a1)).cwiseAbs().maxCoeff(), 1e-9 * rate) << k;
    const Eigen::VectorXd by_s = drive.s.col(k + 1) - drive.s.col(k) - kDt * drive.rate.col(k);
    EXPECT_LT((by_s - kDt * kDt / 6 * (2 * a + a1)).cwiseAbs().maxCoeff(), 1e-10 * s) << k;
  }
  // And near central differences of the values.
  double rate_apart = 0, second_apart = 0;
  for (int k = 5; k < 95; ++k) {  // the motion is held from step 100 on
    const Eigen::VectorXd d1 = (drive.s.col(k + 1) - drive.s.col(k - 1)) / (2 * kDt);
    const Eigen::VectorXd d2 =
        (drive.s.col(k + 1) - 2 * drive.s.col(k) + drive.s.col(k - 1)) / (kDt * kDt);
    rate_apart = std::max(rate_apart, (d1 - drive.rate.col(k)).cwiseAbs().maxCoeff());
    second_apart = std::max(second_apart, (d2 - drive.second.col(k)).cwiseAbs().maxCoeff());
  }
  EXPECT_LT(rate_apart, 0.02 * rate);
  EXPECT_LT(second_apart, 0.1 * second);
}

}  // namespace
}  // namespace hyperex::simulate
