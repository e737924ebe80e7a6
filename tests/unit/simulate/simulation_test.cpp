// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/motion/embedded_motion.hpp"
#include "hyperex/motion/resample.hpp"
#include "hyperex/simulate/drive/boundary.hpp"
#include "hyperex/simulate/drive/support.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

double greatest(const PointsF& d) {
  return d.rowwise().norm().maxCoeff();
}

class Simulation : public testing::Test {
 protected:
  Simulation() {
    Progress::silence(true);
    options_.drive.points = test::seven_points();
    options_.time.step_s = 0.01;
  }
  ~Simulation() override { Progress::silence(false); }

  SimulationResult run(const AlignedMotion& motion) const {
    return simulate(face_.mesh, face_.landmarks, motion, options_);
  }
  SimulationResult run() const { return run(motion_); }
  void let_everything_go() {
    options_.support.border_held = false;
    options_.support.skull = Hold::free;
    options_.support.mandible = Mandible::free;
    options_.support.field_pa_per_m = 0;
  }

  const test::SmallFace face_ = test::small_face();
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 10, 13, 30);
  SimulationOptions options_;
};

TEST_F(Simulation, NoInputNoMotion) {
  const auto still =
      test::motion_of(face_.landmarks, 7, 30, [](auto&, auto&, int) { return Vec3::Zero(); });
  for (const Measured measured : {Measured::none, Measured::all}) {
    options_.region.measured = measured;
    const SimulationResult r = run(still);
    ASSERT_EQ(r.performance.skin_displacement_m.size(), 7u);
    for (const PointsF& d : r.performance.skin_displacement_m)
      EXPECT_LT(greatest(d), 1e-12);  // nanometres would be far too much
    EXPECT_EQ(r.report.inverted_tets, 0);
    EXPECT_EQ(r.report.lip_overlap_mm, 0);
  }
}

TEST_F(Simulation, FollowsATranslationOfEverythingDriven) {
  let_everything_go();
  const Vec3 shift(0.004, -0.003, 0.002);
  const auto moved = test::motion_of(face_.landmarks, 31, 30, [&](auto&, auto&, int k) {
    return Vec3(shift * std::min(1.0, k / 10.0));
  });
  options_.drive.points = face::all_ibug();
  options_.time.end_s = 3;
  const SimulationResult r = run(moved);
  const PointsF& last = r.performance.node_displacement_m.back();
  for (Eigen::Index n = 0; n < last.rows(); ++n)
    EXPECT_LT((last.row(n).transpose().cast<double>() - shift).norm(), 0.02 * shift.norm()) << n;
}

TEST_F(Simulation, MeasuredEverywhereIsTheBarycentricDisplacement) {
  options_.region.measured = Measured::all;
  options_.time.still_times_s = {0.123};
  const SimulationResult r = run();
  const MeasuredRegion region =
      measured_region(face_.mesh, face_.landmarks, motion_, options_.region);
  const motion::MotionCurve curve(motion_.motion);
  const auto expect = [&](const PointsF& found, double t) {
    const Points d = curve.at(t) - motion_.rest;
    for (Eigen::Index v = 0; v < found.rows(); ++v)
      EXPECT_LT((found.row(v).cast<double>().transpose() - region.skin[v].displacement(d)).norm(),
                1e-9);
  };
  for (std::size_t f = 0; f < r.performance.frame_time_s.size(); ++f)
    expect(r.performance.skin_displacement_m[f], r.performance.frame_time_s[f]);
  expect(r.still_displacement_m[0], 0.123);
  EXPECT_GT(greatest(r.still_displacement_m[0]), 0.003);
  EXPECT_TRUE(r.performance.nodes.size() == 0 && r.performance.node_displacement_m.empty());
}

TEST_F(Simulation, GainScalesALinearModel) {
  // Not linear: the jaw's turning, and how far the field is opened where both lips are driven.
  options_.support.mandible = Mandible::free;
  options_.drive.points = {"ibug68_48", "ibug68_54", "ibug68_8", "ibug68_57"};
  const SimulationResult once = run();
  for (const double gain : {2.0, 0.5}) {
    options_.drive.gain = gain;
    const SimulationResult scaled = run();
    for (std::size_t f = 0; f < once.performance.frame_time_s.size(); ++f)
      EXPECT_LT((scaled.performance.node_displacement_m[f] -
                 static_cast<float>(gain) * once.performance.node_displacement_m[f])
                    .cwiseAbs()
                    .maxCoeff(),
                1e-9);
  }
}

TEST_F(Simulation, DrivenNodesTakeTheInputExactlyAndTheLastSampleIsHeld) {
  options_.time.end_s = 0.6;  // the motion lasts 0.4 s
  auto motion = motion_;      // and is cut off at its widest
  motion.motion.time_s.resize(8);
  motion.motion.positions.resize(8);
  const SimulationResult r = run(motion);
  EXPECT_EQ(r.performance.frame_time_s.size(), 19u);
  Boundary boundary(face_.mesh, face_.landmarks, motion,
                    measured_region(face_.mesh, face_.landmarks, motion, options_.region),
                    options_.drive, options_.support);
  const motion::MotionCurve curve(motion.motion);
  Eigen::VectorXd values(boundary.prescribed().size());
  Eigen::VectorXd force(3 * face_.mesh.volume.nodes.rows());
  for (std::size_t f = 0; f < r.performance.frame_time_s.size(); ++f) {
    if (f % 3) continue;  // frames at 0, 0.1, 0.2 ... s are steps
    const double t = r.performance.frame_time_s[f];
    const Points d = curve.at(std::min(t, 7 / 30.0)) - motion.rest;
    boundary.prescribe(d, boundary.follow(d), values, force);
    for (std::size_t i = 0; i < boundary.prescribed().size(); ++i) {
      const int u = boundary.prescribed()[i];
      EXPECT_NEAR(r.performance.node_displacement_m[f](u / 3, u % 3), values[i], 1e-8);
    }
  }
  const auto& d = r.performance.node_displacement_m;
  EXPECT_GT(greatest(d.back()), 0.005) << "still open";
}

TEST_F(Simulation, FramesBetweenStepsAreInterpolated) {
  options_.time.step_s = 0.008;
  options_.time.frame_rate_hz = 125;  // every step
  options_.time.end_s = 0.408;        // a step after the last frame, which is at 0.4 s
  const SimulationResult steps = run();
  options_.time.frame_rate_hz = 30;
  options_.time.still_times_s = {0.0, 0.205, 0.05};
  const SimulationResult frames = run();
  const auto expect = [&](const PointsF& found, double t) {
    const auto before = static_cast<std::size_t>(std::floor(t / 0.008 + 1e-9));
    const float a = static_cast<float>(t / 0.008 - double(before));
    ASSERT_LT(before + 1, steps.performance.skin_displacement_m.size());
    const PointsF between = (1 - a) * steps.performance.skin_displacement_m[before] +
                            a * steps.performance.skin_displacement_m[before + 1];
    EXPECT_LT((found - between).cwiseAbs().maxCoeff(), 1e-8) << t;
  };
  ASSERT_EQ(frames.performance.frame_time_s.size(), 13u);
  for (std::size_t f = 0; f < 13; ++f) {
    EXPECT_DOUBLE_EQ(frames.performance.frame_time_s[f], double(f) / 30);
    expect(frames.performance.skin_displacement_m[f], double(f) / 30);
  }
  for (int i = 0; i < 3; ++i)
    expect(frames.still_displacement_m[i], options_.time.still_times_s[i]);
}

/// A recording that ends at its widest keeps it.
TEST_F(Simulation, TheLastSampleIsAFrame) {
  auto motion = motion_;  // at 30 Hz
  motion.motion.time_s.resize(7);
  motion.motion.positions.resize(7);
  options_.time.still_times_s = {1.0};  // later than the end: the end
  const SimulationResult r = run(motion);
  ASSERT_EQ(r.performance.frame_time_s.size(), 7u);
  EXPECT_DOUBLE_EQ(r.performance.frame_time_s.back(), 0.2);
  EXPECT_EQ(r.performance.skin_displacement_m.back(), r.still_displacement_m[0]);
  EXPECT_EQ(r.performance.peak_frame, 6);
}

TEST_F(Simulation, FramesAgreeWithACommensurateStep) {
  options_.time.step_s = 0.004;  // 30 Hz falls between
  const SimulationResult between = run();
  options_.time.step_s = 1.0 / 240;
  const SimulationResult on = run();
  double most = 0;
  for (std::size_t f = 0; f < on.performance.frame_time_s.size(); ++f) {
    most = std::max(most, double(greatest(on.performance.skin_displacement_m[f])));
    EXPECT_LT(greatest(on.performance.skin_displacement_m[f] -
                       between.performance.skin_displacement_m[f]),
              0.0002);
  }
  EXPECT_GT(most, 0.01);
}

TEST_F(Simulation, TheSameRunTwiceIsBitIdentical) {
  const SimulationResult a = run(), b = run();
  for (std::size_t f = 0; f < a.performance.frame_time_s.size(); ++f) {
    EXPECT_EQ(a.performance.skin_displacement_m[f], b.performance.skin_displacement_m[f]);
    EXPECT_EQ(a.performance.node_displacement_m[f], b.performance.node_displacement_m[f]);
    EXPECT_EQ(a.performance.landmarks.positions[f], b.performance.landmarks.positions[f]);
  }
}

TEST_F(Simulation, OpensTheMouth) {
  const SimulationResult r = run();
  const Performance& p = r.performance;
  EXPECT_EQ(p.peak_frame, 6) << "half way through the motion";
  const auto moved = [&](const char* name) {
    const int i = p.landmarks.index_of(name);
    return (p.landmarks.positions[p.peak_frame].row(i) - p.landmarks.positions[0].row(i)).norm();
  };
  EXPECT_GT(moved("ibug68_66"), 0.010) << "the lower lip";
  EXPECT_LT(moved("ibug68_62"), 0.005) << "the upper lip";
  EXPECT_LT(moved("ibug68_27"), 0.001) << "the nasion";
  EXPECT_GT(r.report.lip_gap_mm, 6) << "the patches around the lips take in some of each";
  EXPECT_NEAR(r.report.greatest_opening_deg, 10, 1);
  EXPECT_EQ(r.report.steps, 40);
  EXPECT_GT(r.report.free_dofs, 1000);
  EXPECT_EQ(p.driven_names, test::seven_points());
  EXPECT_EQ(p.driven_points_rest.rows(), 7);
  EXPECT_EQ(p.skin_rest.points, face_.mesh.skin.points);
  EXPECT_EQ(p.material.young_pa.size(), static_cast<std::size_t>(face_.mesh.volume.tets.rows()));
  options_.time.peak_time_s = 0.1;
  EXPECT_EQ(run().performance.peak_frame, 3);
}

TEST_F(Simulation, ReportsInvertedElements) {
  options_.drive.gain = 5;
  EXPECT_GT(run(test::mouth_opening(face_.landmarks, 25, 13, 30)).report.inverted_tets, 0);
}

TEST_F(Simulation, WhatTheMandibleDoesMatters) {
  options_.support.mandible = Mandible::follow;
  const SimulationResult follow = run();
  options_.support.mandible = Mandible::free;
  const SimulationResult free = run();
  options_.support.mandible = Mandible::held;
  const SimulationResult held = run();
  const auto inner_mean = [&](const SimulationResult& r) {  // of the inner side under the chin
    const auto bones = bones_under(face_.mesh, face_.landmarks);
    double sum = 0;
    int count = 0;
    for (std::size_t v = 0; v < bones.size(); ++v)
      if (bones[v] == Bone::mandible) {
        sum +=
            r.performance.node_displacement_m[6].row(face_.mesh.volume.inner_node(int(v))).norm();
        ++count;
      }
    return sum / count;
  };
  EXPECT_LT(inner_mean(held), 1e-9);
  EXPECT_GT(inner_mean(follow), 1.05 * inner_mean(free)) << "the bone carries what the skin drags";
  EXPECT_GT(inner_mean(free), 0.001);
}

TEST_F(Simulation, ViscosityMakesItLag) {
  let_everything_go();
  options_.support.border_held = true;
  options_.tissue.uniform[tissue::viscosity] = 20;
  const SimulationResult thin = run();
  options_.tissue.uniform[tissue::viscosity] = 20000;
  const SimulationResult thick = run();
  // On the way and at the end, where the driven skin is the same and the rest has not followed.
  const auto &a = thin.performance.skin_displacement_m, &b = thick.performance.skin_displacement_m;
  for (const std::size_t frame : {std::size_t(6), a.size() - 1})
    EXPECT_GT((a[frame] - b[frame]).norm(), 1e-3 * a[6].norm()) << frame;
}

TEST_F(Simulation, PartsMeasuredFollowTheTriangles) {
  options_.region.measured = Measured::points;
  options_.region.measured_points = {"ibug68_8"};
  options_.region.measured_radius_m = 0.02;
  const SimulationResult r = run();
  const MeasuredRegion region =
      measured_region(face_.mesh, face_.landmarks, motion_, options_.region);
  const Points d = motion_.motion.positions[6] - motion_.rest;
  int measured = 0;
  for (std::size_t v = 0; v < region.share.size(); ++v) {
    if (region.share[v] < 1) continue;
    ++measured;
    const Vec3 found = r.performance.skin_displacement_m[6].row(v).cast<double>();
    EXPECT_LT((found - region.skin[v].displacement(d)).norm(), 1e-8);
    // The tissue under it is driven by the same (0.2 s is a step).
    const Vec3 node = r.performance.node_displacement_m[6].row(v).cast<double>();
    EXPECT_LT((node - region.skin[v].displacement(d)).norm(), 1e-8);
  }
  EXPECT_GT(measured, 3);
}

TEST(EmbeddedFace, OpensItsMouthWithoutInvertingTissue) {
  Progress::silence(true);
  const anatomy::EmbeddedFace face = anatomy::embedded_face();
  tissue::TissueMeshOptions mesh_options;
  mesh_options.element_size_m = 0.005;
  const tissue::TissueMesh mesh =
      tissue::build_tissue_mesh(face.mesh, face.landmarks, mesh_options, "embedded face");
  EXPECT_GT(mesh.quality.least_volume_mm3, 0);
  EXPECT_TRUE(mesh.lip_cut.rows() == 0) << "its mouth is open already";
  motion::MouthOpeningOptions opening;
  opening.peak_deg = 10;
  opening.duration_s = 0.5;
  opening.head_moves = false;
  const AlignedMotion motion = align(motion::embedded_mouth_opening(face.landmarks, opening),
                                     face.landmarks, AlignmentMethod::nonrigid);
  SimulationOptions options;
  options.drive.points = test::seven_points();
  options.time.step_s = 0.01;
  const SimulationResult r = simulate(mesh, face.landmarks, motion, options);
  const Performance& p = r.performance;
  const auto lowered = [&](const char* name) {
    const int i = p.landmarks.index_of(name);
    return p.landmarks.positions[0](i, 1) - p.landmarks.positions[p.peak_frame](i, 1);
  };
  EXPECT_GT(lowered("ibug68_66"), 0.007);
  EXPECT_GT(lowered("ibug68_57"), 0.009);
  EXPECT_GT(r.report.lip_gap_mm, 5);
  EXPECT_LT(std::abs(lowered("ibug68_51")), 0.003);
  EXPECT_LT(std::abs(lowered("ibug68_62")), 0.005);
  EXPECT_EQ(r.report.inverted_tets, 0);
  EXPECT_LT(r.report.lip_overlap_mm, 1);
  Progress::silence(false);
}

}  // namespace
}  // namespace hyperex::simulate
