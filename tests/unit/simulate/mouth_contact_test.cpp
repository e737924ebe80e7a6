// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/mouth_contact.hpp"

#include <gtest/gtest.h>

#include <thread>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/core/progress.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "unit/simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

/// A face whose lower lip is moved up into the upper one and back.
class MouthContactOfAFace : public testing::Test {
 protected:
  MouthContactOfAFace() {
    Progress::silence(true);
    for (int k = 48; k < 68; ++k) options_.drive.points.push_back(face::ibug(k));
    options_.time.step_s = 0.01;
  }
  ~MouthContactOfAFace() override { Progress::silence(false); }

  /// Until the lips' middles have passed each other by so much.
  AlignedMotion closing(double past_m) const {
    const double up_m =
        past_m + (face_.landmarks.at("ibug68_62") - face_.landmarks.at("ibug68_66")).norm();
    return test::motion_of(face_.landmarks, 13, 30, [&](const std::string& name, auto&, int k) {
      const double share = k < 6 ? k / 6.0 : (12 - k) / 6.0;
      return anatomy::lip_of(name) < 0 ? Vec3(0, share * up_m, -share * 0.002)
                                       : Vec3::Zero().eval();
    });
  }
  SimulationResult run(const AlignedMotion& motion, bool contact) {
    options_.contact.lips = contact;
    return simulate(face_.mesh, face_.landmarks, motion, options_);
  }
  static bool same(const SimulationResult& a, const SimulationResult& b) {
    return a.performance.skin_displacement_m == b.performance.skin_displacement_m &&
           a.performance.node_displacement_m == b.performance.node_displacement_m;
  }

  const test::SmallFace face_ = test::small_face();
  SimulationOptions options_;
};

TEST_F(MouthContactOfAFace, ChangesNothingWhereNothingTouches) {
  const AlignedMotion open = test::mouth_opening(face_.landmarks, 10, 13, 30);
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    options_.drive.by = by;
    const SimulationResult with = run(open, true);
    EXPECT_EQ(with.report.contact.frames, 0);
    EXPECT_TRUE(same(run(open, false), with));
  }
}

TEST_F(MouthContactOfAFace, KeepsLipsApartAndLeavesRestAlone) {
  const AlignedMotion shut = closing(0.002);
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    options_.drive.by = by;
    const SimulationResult free = run(shut, false), with = run(shut, true);
    EXPECT_GT(with.report.contact.overlap_mm, 0.5);
    EXPECT_LT(with.report.contact.left_mm, 0.012) << "a single round leaves 0.017 and 0.039";
    EXPECT_LT(with.report.contact.residual_mm, 0.05);
    EXPECT_GT(with.report.contact.frames, 0);
    EXPECT_EQ(free.report.contact.frames, 0) << "off";
    EXPECT_EQ(free.report.lip_overlap_mm, with.report.contact.overlap_mm) << "one measure";
    EXPECT_EQ(with.report.lip_overlap_mm, with.report.contact.left_mm);
    EXPECT_EQ(free.performance.skin_displacement_m.front(),
              with.performance.skin_displacement_m.front())
        << "no jump at rest";
    EXPECT_TRUE(same(with, run(shut, true))) << "twice the same";
  }
}

TEST_F(MouthContactOfAFace, VariantsTouchToo) {
  options_.drive.by = DriveBy::muscles;
  options_.contact.lips = true;
  const std::shared_ptr<const tissue::TissueMesh> mesh(std::shared_ptr<void>(), &face_.mesh);
  Simulator base(mesh, face_.landmarks, closing(0.002), options_);
  base.hold_load();
  const SimulationResult found = base.run();
  ASSERT_GT(found.report.contact.frames, 0);
  EXPECT_TRUE(same(found, base.run()));
  Simulator variant(base);
  EXPECT_TRUE(same(found, variant.run())) << "nothing was changed";
  SimulationOptions same_but_tissue = options_;
  same_but_tissue.tissue.uniform[tissue::viscosity] *= 1 + 1e-9;
  variant.set_options(same_but_tissue);
  const SimulationResult answered = variant.run();
  double apart = 0;
  for (std::size_t f = 0; f < found.performance.skin_displacement_m.size(); ++f)
    apart = std::max(apart, double((found.performance.skin_displacement_m[f] -
                                    answered.performance.skin_displacement_m[f])
                                       .cwiseAbs()
                                       .maxCoeff()));
  EXPECT_LT(apart, 1e-5) << "as good as the same tissue";
  EXPECT_LT(answered.report.contact.left_mm, 0.1);
}

TEST_F(MouthContactOfAFace, AStreamKeepsTheLipsApart) {
  const AlignedMotion shut = closing(0.002);
  const std::shared_ptr<const tissue::TissueMesh> mesh(std::shared_ptr<void>(), &face_.mesh);
  const auto stream_of = [&](bool contact) {
    options_.contact.lips = contact;
    Simulator simulator(mesh, face_.landmarks, shut, options_);
    simulator.start_stream(1.0 / 30);
    std::vector<PointsF> frames;
    for (const Points& points : shut.motion.positions)
      frames.push_back(simulator.step(points - shut.rest));
    return frames;
  };
  const LipSurfaces lips(face_.mesh, face_.landmarks);
  const std::vector<PointsF> free = stream_of(false), with = stream_of(true);
  double before = 0, after = 0;
  int alike = 0;
  for (std::size_t f = 0; f < free.size(); ++f) {
    before = std::max(before, lips.depth(free[f]));
    after = std::max(after, lips.depth(with[f]));
    alike += free[f] == with[f];
  }
  EXPECT_GT(before, 0.5e-3);
  EXPECT_LT(after, 0.02e-3);
  EXPECT_GT(alike, 2) << "no lip is in the other's way";
  EXPECT_LT(alike, int(free.size()));
}

TEST_F(MouthContactOfAFace, AStreamHasNoContactWithTeethOrEyes) {
  for (bool ContactOptions::*const key : {&ContactOptions::teeth, &ContactOptions::eyes}) {
    options_.contact = {};
    options_.contact.*key = true;
    Simulator simulator(
        std::shared_ptr<const tissue::TissueMesh>(std::shared_ptr<void>(), &face_.mesh),
        face_.landmarks, closing(0.002), options_);
    EXPECT_THROW(simulator.start_stream(1.0 / 30), InputError);
  }
}

/// `make tsan` runs this test: a face and its mirrored twin have contact in parallel threads.
TEST_F(MouthContactOfAFace, CopiesTouchOnTheirOwnInOtherThreads) {
  options_.contact.lips = true;
  const std::shared_ptr<const tissue::TissueMesh> mesh(std::shared_ptr<void>(), &face_.mesh);
  for (const Strain strain : {Strain::linear, Strain::finite}) {
    options_.model.strain = strain;
    Simulator base(mesh, face_.landmarks, closing(0.002), options_);
    const SimulationResult alone = base.run();
    ASSERT_GT(alone.report.contact.frames, 0);
    Simulator copy = base;
    SimulationResult of_copy, of_base;
    std::thread other([&] { of_copy = copy.run(); });
    of_base = base.run();
    other.join();
    EXPECT_TRUE(same(alone, of_base));
    EXPECT_TRUE(same(alone, of_copy));
  }
}

}  // namespace
}  // namespace hyperex::simulate
