// SPDX-License-Identifier: GPL-3.0-or-later
// Faces at finite strain: the linear solution for small motions, recordings reproduced by forces,
// and forces that rotate with the tissue.
#include <gmock/gmock.h>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/simulate/run/node_rotations.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

class FiniteRun : public testing::Test {
 protected:
  FiniteRun() {
    options_.time.step_s = 0.01;
    options_.model.strain = Strain::finite;
    options_.drive.points = test::seven_points();
  }
  /// A left smile that is held at the end.
  AlignedMotion smile(double size) const {
    const face::FaceFrame frame = face::face_frame(face_.landmarks);
    return test::motion_of(
        face_.landmarks, 16, 30, [&](const std::string& name, const Vec3&, int k) -> Vec3 {
          const double t = std::min(1.0, k / 10.0);
          if (name != "ibug68_54") return Vec3::Zero();
          return size * t * t * (3 - 2 * t) * (0.006 * frame.x + 0.005 * frame.y - 0.002 * frame.z);
        });
  }
  Simulator made(const SimulationOptions& options, const AlignedMotion& motion) const {
    return Simulator(mesh_, face_.landmarks, motion, options);
  }
  /// Greatest distance between two runs' skins at the end, over the greatest displacement there.
  static double apart(const SimulationResult& a, const SimulationResult& b) {
    const PointsF& x = a.performance.skin_displacement_m.back();
    const PointsF& y = b.performance.skin_displacement_m.back();
    return (x - y).rowwise().norm().maxCoeff() / x.rowwise().norm().maxCoeff();
  }
  static double way(const SimulationResult& result, const std::string& name) {
    const auto& tracks = result.performance.landmarks;
    const int row = tracks.index_of(name);
    return (tracks.positions.back().row(row) - tracks.positions.front().row(row)).norm();
  }

  const test::SmallFace face_ = test::small_face();
  std::shared_ptr<const tissue::TissueMesh> mesh_ =
      std::make_shared<const tissue::TissueMesh>(face_.mesh);
  SimulationOptions options_;
};

TEST_F(FiniteRun, ASmallMotionIsTheLinearAnswer) {
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    options_.drive.by = by;
    options_.model.strain = Strain::linear;
    const auto linear = made(options_, smile(0.01)).run();
    const auto large = made(options_, smile(1)).run();
    options_.model.strain = Strain::finite;
    EXPECT_LT(apart(linear, made(options_, smile(0.01)).run()), 0.005);
    EXPECT_GT(apart(large, made(options_, smile(1)).run()), 0.01) << "but not a large one";
  }
}

/// For larger motions the driven nodes themselves would invert an element.
TEST_F(FiniteRun, AViolentMotionTurnsNoElementInsideOut) {
  options_.model.strain = Strain::linear;
  EXPECT_GT(made(options_, smile(2.2)).run().report.inverted_tets, 0);
  options_.model.strain = Strain::finite;
  const auto finite = made(options_, smile(2.2)).run();
  EXPECT_EQ(finite.report.inverted_tets, 0);
  EXPECT_GT(finite.report.iterations, 0);
  EXPECT_LE(finite.report.estimated_error, options_.solver.finite_tolerance);
}

TEST_F(FiniteRun, ByMusclesMeetsTheRecordingAndTheSameForcesMakeItAgain) {
  options_.drive.by = DriveBy::muscles;
  options_.model.strain = Strain::linear;
  const double off_mm = made(options_, smile(1)).run().report.driven_off_mm;
  options_.model.strain = Strain::finite;
  Simulator simulator = made(options_, smile(1));
  const auto base = simulator.run();
  EXPECT_NEAR(base.report.driven_off_mm, off_mm, 0.01);
  simulator.hold_load();
  options_.time.still_times_s = {0.1};  // any change but of forces
  simulator.set_options(options_);
  const auto again = simulator.run();
  EXPECT_LT(apart(base, again), 0.005) << "now nothing is prescribed";
}

TEST_F(FiniteRun, GainsActOnForcesAsRecorded) {
  options_.drive.by = DriveBy::muscles;
  Simulator simulator = made(options_, smile(1));
  const auto base = simulator.run();
  simulator.hold_load();
  options_.muscles.gains = {{"side_L", 0.3}};
  simulator.set_options(options_);
  const auto weak = simulator.run();
  EXPECT_LT(way(weak, "ibug68_54"), 0.8 * way(base, "ibug68_54"));
  EXPECT_LT(apart(weak, made(options_, smile(1)).run()), 0.005)
      << "in one run that finds its forces by itself";
}

TEST_F(FiniteRun, WithoutMusclesOnASideItsCornerHardlyMoves) {
  options_.drive.by = DriveBy::muscles;
  Simulator simulator = made(options_, smile(1));
  const auto base = simulator.run();
  simulator.hold_load();
  options_.muscles.gains = {{"side_L", 0}};
  simulator.set_options(options_);
  EXPECT_LT(way(simulator.run(), "ibug68_54"), 0.2 * way(base, "ibug68_54"));
}

TEST_F(FiniteRun, StifferTissueAnswersTheSameForcesWithLess) {
  options_.drive.by = DriveBy::muscles;
  Simulator simulator = made(options_, smile(1));
  const auto base = simulator.run();
  simulator.hold_load();
  options_.tissue.uniform[tissue::young] *= 3;
  simulator.set_options(options_);
  EXPECT_LT(way(simulator.run(), "ibug68_54"), 0.8 * way(base, "ibug68_54"));
}

TEST_F(FiniteRun, RefusesWhatItCannotDo) {
  const auto expect_refused = [&](const SimulationOptions& wrong, const char* what) {
    EXPECT_THAT(hyperex::test::refusal([&] { made(wrong, smile(1)); }), testing::HasSubstr(what));
  };
  SimulationOptions wrong = options_;
  wrong.drive.by = DriveBy::reactions;
  expect_refused(wrong, "drive.by");
  wrong = options_;
  wrong.model.viscous_form = fem::ViscousForm::printed;
  expect_refused(wrong, "viscous_form");
  wrong = options_;
  wrong.solver.finite_step_s = 1e-6;
  expect_refused(wrong, "finite_step_s");
  wrong = options_;
  wrong.model.law.law = fem::HyperelasticLaw::yeoh;
  wrong.model.law.c20 = -1;
  expect_refused(wrong, "model.law");
}

TEST_F(FiniteRun, ForcesHeldAtSmallStrainAreNotForFiniteStrain) {
  options_.drive.by = DriveBy::muscles;
  options_.model.strain = Strain::linear;
  Simulator simulator = made(options_, smile(1));
  simulator.run();
  simulator.hold_load();
  options_.model.strain = Strain::finite;
  options_.tissue.uniform[tissue::young] *= 3;
  EXPECT_THROW(simulator.set_options(options_), InputError);
  EXPECT_EQ(simulator.options().model.strain, Strain::linear) << "nothing changed";
}

TEST_F(FiniteRun, ThereAndBackIsAsNew) {
  options_.model.strain = Strain::linear;
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    options_.drive.by = by;
    Simulator simulator = made(options_, smile(1));
    const auto linear = simulator.run();
    SimulationOptions finite = options_;
    finite.model.strain = Strain::finite;
    simulator.set_options(finite);
    EXPECT_EQ(apart(simulator.run(), made(finite, smile(1)).run()), 0);
    simulator.set_options(options_);
    EXPECT_EQ(apart(simulator.run(), linear), 0);
  }
}

TEST_F(FiniteRun, AStreamKnowsNoFiniteStrain) {
  Simulator simulator = made(options_, smile(1));
  EXPECT_THROW(simulator.start_stream(0.02), InputError);
}

TEST_F(FiniteRun, FramesBetweenStepsLieOnTheMotion) {
  options_.solver.finite_step_s = 1 / 30.0;
  const auto base = made(options_, smile(1)).run();
  options_.time.frame_rate_hz *= 2;
  const auto between = made(options_, smile(1)).run();
  const auto& d = between.performance.node_displacement_m;
  const auto& at_steps = base.performance.node_displacement_m;
  ASSERT_GE(d.size() + 1, 2 * at_steps.size());
  double most = 0, off = 0;
  for (std::size_t f = 1; f + 2 < at_steps.size(); ++f) {
    EXPECT_LT((d[2 * f] - at_steps[f]).cwiseAbs().maxCoeff(), 1e-6) << "a step's end";
    // Hermite's cubic through evenly spaced ends of a smooth motion is near the cubic through four.
    const auto middle =
        ((9 * (at_steps[f] + at_steps[f + 1]) - at_steps[f - 1] - at_steps[f + 2]) / 16.0F).eval();
    off = std::max(off, double((d[2 * f + 1] - middle).cwiseAbs().maxCoeff()));
    most = std::max(most, double((at_steps[f + 1] - at_steps[f]).cwiseAbs().maxCoeff()));
  }
  EXPECT_LT(off, 0.08 * most);
}

TEST_F(FiniteRun, ForcesTurnWithTheTissue) {
  const auto& volume = mesh_->volume;
  const fem::Assembler assembler(volume.nodes, volume.tets, fem::ElementKind::tet4);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(0.7, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  const Eigen::Matrix3d stretch = Vec3(1.2, 0.9, 1.05).asDiagonal();
  Eigen::VectorXd d(3 * volume.nodes.rows());
  for (Eigen::Index n = 0; n < volume.nodes.rows(); ++n) {
    const Vec3 x = volume.nodes.row(n);
    d.segment<3>(3 * n) = turn * stretch * x - x;
  }
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(d.size(), 1);
  force.col(0).segment<3>(30) = Vec3(1, -2, 3);
  NodeRotations rotations(assembler, force);
  rotations.update(d);
  Eigen::VectorXd out = Eigen::VectorXd::Zero(d.size());
  rotations.add_turned(force.col(0), out);
  EXPECT_LT((out.segment<3>(30) - turn * Vec3(1, -2, 3)).norm(), 1e-8);
  EXPECT_NEAR(out.norm(), force.norm(), 1e-8) << "nowhere else";
}

}  // namespace
}  // namespace hyperex::simulate
