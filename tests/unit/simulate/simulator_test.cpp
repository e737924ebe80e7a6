// SPDX-License-Identifier: GPL-3.0-or-later
// Results that a simulator keeps between runs: keeping them changes no number.
#include "hyperex/simulate/run/simulator.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <thread>

#include "hyperex/core/error.hpp"
#include "hyperex/simulate/drive/point_curve.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

class SimulatorOfAFace : public testing::Test {
 protected:
  SimulatorOfAFace() { options_.time.step_s = 0.01; }
  Simulator made(const SimulationOptions& options) const {
    return Simulator(mesh_, landmarks_, motion_, options);
  }
  static void expect_equal(const SimulationResult& a, const SimulationResult& b) {
    ASSERT_EQ(a.performance.skin_displacement_m.size(), b.performance.skin_displacement_m.size());
    for (std::size_t f = 0; f < a.performance.skin_displacement_m.size(); ++f) {
      EXPECT_EQ(a.performance.skin_displacement_m[f], b.performance.skin_displacement_m[f]) << f;
      EXPECT_EQ(a.performance.node_displacement_m[f], b.performance.node_displacement_m[f]) << f;
    }
    EXPECT_EQ(a.performance.landmarks.positions.back(), b.performance.landmarks.positions.back());
    EXPECT_EQ(a.performance.material.young_pa, b.performance.material.young_pa);
    EXPECT_EQ(a.report.basis_size, b.report.basis_size);
    EXPECT_EQ(a.report.driven_nodes, b.report.driven_nodes);
    EXPECT_EQ(a.report.inverted_tets, b.report.inverted_tets);
  }
  /// Runs, sets `next`, and runs again: as a simulator made with `next`.
  void expect_as_anew(const SimulationOptions& next) {
    Simulator simulator = made(options_);
    const SimulationResult before = simulator.run();
    simulator.set_options(next);
    const SimulationResult after = simulator.run();
    expect_equal(after, made(next).run());
    EXPECT_NE(after.performance.skin_displacement_m[6], before.performance.skin_displacement_m[6])
        << "what was set has an effect";
  }

  const test::SmallFace face_ = test::small_face();
  const std::shared_ptr<const tissue::TissueMesh> mesh_ =
      std::make_shared<const tissue::TissueMesh>(face_.mesh);
  const io::Landmarks landmarks_ = face_.landmarks;
  const AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 10, 13, 30);
  SimulationOptions options_;
};

TEST_F(SimulatorOfAFace, AnotherRunIsEqualAndComputesNothing) {
  Simulator simulator = made(options_);
  const SimulationResult once = simulator.run(), again = simulator.run();
  expect_equal(once, again);
  EXPECT_GT(once.report.factor_s, 0);
  EXPECT_GT(once.report.analyse_s, 0);
  for (const double spent :
       {again.report.assemble_s, again.report.analyse_s, again.report.factor_s})
    EXPECT_EQ(spent, 0);
}

TEST_F(SimulatorOfAFace, AStillIsAFrameOfASlowMotion) {
  for (const DriveBy by : {DriveBy::displacement, DriveBy::muscles}) {
    SimulationOptions options = options_;
    options.drive.by = by;
    options.tissue.uniform[tissue::viscosity] = 1;
    options.tissue.uniform[tissue::density] = 1;
    Simulator simulator = made(options);
    const PointsF before = simulator.still(0.2);  // nothing was run yet
    const SimulationResult result = simulator.run();
    const PointsF& frame = result.performance.skin_displacement_m[6];
    EXPECT_LT((before - frame).cwiseAbs().maxCoeff(), 2e-3 * frame.cwiseAbs().maxCoeff());
    EXPECT_EQ(simulator.still(0.2), before);
    EXPECT_LT(simulator.still(0).cwiseAbs().maxCoeff(), 1e-9);
    simulator.hold_load();
    TissueValues stiff = options.tissue;
    stiff.uniform[tissue::young] *= 3;
    simulator.set_tissue(stiff);
    const PointsF stiffer = simulator.still(0.2);
    const PointsF again = simulator.run().performance.skin_displacement_m[6];
    EXPECT_LT((stiffer - again).cwiseAbs().maxCoeff(), 2e-3 * again.cwiseAbs().maxCoeff());
    EXPECT_GT((stiffer - before).cwiseAbs().maxCoeff(), 1e-5);
  }
}

TEST_F(SimulatorOfAFace, OtherTissueFactorsAgainAndKeepsTheOrder) {
  Simulator simulator = made(options_);
  simulator.run();
  TissueValues stiff = options_.tissue;
  stiff.element = {};
  for (int p = 0; p < tissue::parameter_count; ++p)
    stiff.element[p].assign(std::size_t(mesh_->volume.tets.rows()), stiff.uniform[p]);
  for (std::size_t t = 0; t < stiff.element[tissue::young].size(); t += 2)
    stiff.element[tissue::young][t] *= 10;
  simulator.set_tissue(stiff);
  const SimulationResult result = simulator.run();
  EXPECT_EQ(result.report.analyse_s, 0);
  EXPECT_GT(result.report.factor_s, 0);
  SimulationOptions next = options_;
  next.tissue = stiff;
  expect_equal(result, made(next).run());
}

TEST_F(SimulatorOfAFace, EachPartSetIsAsASimulatorMadeWithIt) {
  const auto with = [&](auto change) {
    SimulationOptions next = options_;
    change(next);
    return next;
  };
  expect_as_anew(with([](auto& o) { o.tissue.uniform[tissue::viscosity] = 9000; }));
  expect_as_anew(with([](auto& o) { o.model.element = fem::ElementKind::tet4; }));
  expect_as_anew(with([](auto& o) { o.model.viscous_form = fem::ViscousForm::printed; }));
  expect_as_anew(with([](auto& o) { o.support.field_pa_per_m = 0; }));
  expect_as_anew(with([](auto& o) { o.support.mandible = Mandible::free; }));
  expect_as_anew(with([](auto& o) { o.support.skull = Hold::held; }));  // others are prescribed
  expect_as_anew(with([](auto& o) { o.support.border_held = false; }));
  expect_as_anew(with([](auto& o) { o.drive.gain = 0.5; }));
  expect_as_anew(with([](auto& o) { o.drive.points.pop_back(); }));
  expect_as_anew(with([](auto& o) { o.drive.all_points = true; }));
  expect_as_anew(with([](auto& o) { o.drive.patch_radius_m = 0.02; }));
  expect_as_anew(with([](auto& o) { o.drive.still_points = {"ibug68_33"}; }));
  expect_as_anew(with([](auto& o) { o.time.step_s = 0.005; }));
  expect_as_anew(with([](auto& o) { o.solver.newmark_gamma = 0.9, o.solver.newmark_beta = 0.5; }));
  expect_as_anew(with([](auto& o) { o.solver.tolerance = 1e-7; }));
  expect_as_anew(with([](auto& o) {
    o.region.measured = Measured::points;
    o.region.measured_points = {"ibug68_8"};
  }));
}

TEST_F(SimulatorOfAFace, AllPointsLeaveOutTheSkullAndTheSlitBetweenTheLips) {
  io::Landmarks measured = landmarks_;
  measured["stomion"] = (landmarks_.at("ibug68_62") + landmarks_.at("ibug68_66")) / 2;
  measured["head_1"] = landmarks_.at("ibug68_27") + Vec3(0, 0.1, -0.05);
  AlignedMotion motion = test::mouth_opening(measured, 10, 13, 30);
  motion.motion.skull_points = {"head_1"};
  SimulationOptions all = options_, named = options_;
  all.drive.all_points = true;
  named.drive.points.clear();
  for (const auto& [name, at] : landmarks_) named.drive.points.push_back(name);
  expect_equal(Simulator(mesh_, landmarks_, motion, all).run(),
               Simulator(mesh_, landmarks_, motion, named).run());
}

TEST_F(SimulatorOfAFace, TheDirectMethodToo) {
  options_.solver.method = SolverMethod::direct;
  SimulationOptions next = options_;
  next.tissue.uniform[tissue::young] *= 3;
  next.tissue.uniform[tissue::viscosity] *= 30;
  expect_as_anew(next);
  next.time.step_s = 0.02;
  expect_as_anew(next);
  Simulator simulator = made(options_);
  expect_equal(simulator.run(), simulator.run());
}

TEST_F(SimulatorOfAFace, TimesOfFramesAndStillsTakeNoNewSolution) {
  Simulator simulator = made(options_);
  simulator.run();
  options_.time.frame_rate_hz = 60;
  options_.time.still_times_s = {0.123};
  simulator.set_options(options_);
  const SimulationResult result = simulator.run();
  EXPECT_EQ(result.report.factor_s, 0);
  const SimulationResult anew = made(options_).run();
  expect_equal(result, anew);
  EXPECT_EQ(result.still_displacement_m[0], anew.still_displacement_m[0]);
}

TEST_F(SimulatorOfAFace, AnotherMotionIsFollowed) {
  const AlignedMotion wider = test::mouth_opening(landmarks_, 14, 13, 30);
  Simulator simulator = made(options_);
  simulator.run();
  simulator.set_motion(wider);
  expect_equal(simulator.run(), Simulator(mesh_, landmarks_, wider, options_).run());
}

TEST_F(SimulatorOfAFace, CopiesRunOnTheirOwnInOtherThreads) {
  Simulator base = made(options_);
  const SimulationResult before = base.run();
  SimulationOptions next = options_;
  next.tissue.uniform[tissue::viscosity] *= 20;
  Simulator copy = base;
  copy.set_options(next);
  SimulationResult of_copy, of_base;
  std::thread other([&] { of_copy = copy.run(); });
  base.set_tissue(options_.tissue);
  of_base = base.run();
  other.join();
  EXPECT_GT(of_copy.report.factor_s, 0) << "a factor of its own";
  expect_equal(of_base, before);
  expect_equal(of_copy, made(next).run());
}

TEST_F(SimulatorOfAFace, AFactorNotNeededAnyMoreIsFilledAgain) {
  Simulator base = made(options_);
  base.run();
  SimulationOptions first = options_, second = options_;
  first.tissue.uniform[tissue::young] *= 3;
  second.tissue.uniform[tissue::young] *= 0.5;
  Simulator spent = base;
  spent.set_options(first);
  EXPECT_GT(spent.run().report.analyse_s, 0);
  Simulator next = base;
  next.reuse_factor(std::move(spent));
  next.set_options(second);
  const SimulationResult result = next.run();
  EXPECT_EQ(result.report.analyse_s, 0);
  EXPECT_GT(result.report.factor_s, 0) << "of other tissue";
  expect_equal(result, made(second).run());
}

TEST_F(SimulatorOfAFace, AFactorOfTheSameMatricesIsTakenAsItIs) {
  Simulator one = made(options_);
  one.run();
  Simulator other = one;
  AlignedMotion motion = motion_;  // the same points drive the same nodes, in another course
  std::swap(motion.motion.positions[3], motion.motion.positions[5]);
  other.set_motion(motion);
  other.reuse_factor(std::move(one));
  const SimulationResult result = other.run();
  EXPECT_EQ(result.report.factor_s, 0);
  expect_equal(result, Simulator(mesh_, landmarks_, motion, options_).run());
}

TEST_F(SimulatorOfAFace, AnOrderIsTakenWhereTheSameUnknownsArePrescribed) {
  Simulator one = made(options_);
  EXPECT_EQ(one.elimination_order(), nullptr);
  const SimulationResult result = one.run();
  const auto order = one.elimination_order();
  ASSERT_TRUE(order);
  Simulator other = made(options_);
  other.use_order(order);
  expect_equal(other.run(), result);
  EXPECT_EQ(other.elimination_order(), order);
  SimulationOptions next = options_;
  next.drive.patch_radius_m *= 2;
  Simulator of_others = made(next);
  of_others.use_order(order);
  expect_equal(of_others.run(), made(next).run());
  EXPECT_NE(of_others.elimination_order(), order);
  auto torn = std::make_shared<EliminationOrder>(*order);
  torn->prescribed.pop_back();
  Simulator last = made(options_);
  last.use_order(torn);
  expect_equal(last.run(), result);
}

TEST_F(SimulatorOfAFace, AFactorOfAnotherOrderIsLeft) {
  Simulator one = made(options_);
  one.run();
  SimulationOptions next = options_;
  next.drive.patch_radius_m *= 2;  // other nodes are prescribed
  Simulator other = made(next);
  other.run();
  Simulator copy = other;
  copy.reuse_factor(std::move(one));
  const SimulationResult result = copy.run();
  EXPECT_GT(result.report.analyse_s, 0);
  expect_equal(result, made(next).run());
}

TEST_F(SimulatorOfAFace, AStreamFollowsAsARunDoes) {
  Simulator simulator = made(options_);
  const SimulationResult run = simulator.run();
  const double interval_s = run.performance.frame_time_s[1] - run.performance.frame_time_s[0];
  const PointCurve points(motion_, options_.drive.gain);
  Simulator live = made(options_);
  live.start_stream(interval_s);
  float most = 0, apart = 0;
  for (std::size_t f = 1; f < run.performance.frame_time_s.size(); ++f) {
    const PointsF skin = live.step(points.at(run.performance.frame_time_s[f]));
    const PointsF& wanted = run.performance.skin_displacement_m[f];
    most = std::max(most, wanted.rowwise().norm().maxCoeff());
    apart = std::max(apart, (skin - wanted).rowwise().norm().maxCoeff());
  }
  EXPECT_GT(most, 0.004F);
  EXPECT_LT(apart, 0.05F * most);  // steps of a frame, damped, in place of 2 ms
}

TEST_F(SimulatorOfAFace, AStreamComesToRestWhereItsTissueNowRests) {
  const PointCurve points(motion_, 1);
  const Points open = points.at(0.3);
  const auto settled = [&](Simulator& simulator) {
    PointsF skin;
    for (int i = 0; i < 60; ++i) skin = simulator.step(open);
    return skin;
  };
  Simulator simulator = made(options_);
  EXPECT_THROW(simulator.step(open), std::logic_error);
  EXPECT_THROW(simulator.start_stream(0), InputError);
  simulator.start_stream(1.0 / 30);
  EXPECT_THROW(simulator.step(open.topRows(1)), InputError);
  const PointsF soft = settled(simulator);
  TissueValues stiff = options_.tissue;
  stiff.uniform[tissue::young] *= 30;
  simulator.set_tissue(stiff);
  const PointsF at_once = simulator.step(open), later = settled(simulator);
  SimulationOptions next = options_;
  next.tissue = stiff;
  Simulator anew = made(next);
  anew.start_stream(1.0 / 30);
  const float most = soft.rowwise().norm().maxCoeff();
  EXPECT_LT((later - settled(anew)).rowwise().norm().maxCoeff(), 1e-4F * most);
  EXPECT_GT((later - soft).rowwise().norm().maxCoeff(), 1e-2F * most);
  EXPECT_LT((at_once - soft).rowwise().norm().maxCoeff(), 0.5F * most) << "it does not begin anew";
}

TEST_F(SimulatorOfAFace, AStreamNamesThePointThatCannotBe) {
  Simulator simulator = made(options_);
  simulator.start_stream(1.0 / 30);
  const Points open = PointCurve(motion_, 1).at(0.2);
  const auto said = [&](const Points& points) {
    return hyperex::test::refusal([&] { simulator.step(points); });
  };
  EXPECT_THAT(said(open.topRows(3)), testing::HasSubstr("3 rows: expected 68 points"));
  Points unmeasured = open;
  unmeasured(11, 1) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(said(unmeasured), testing::HasSubstr("point 12 of 68 is not finite (" +
                                                   motion_.motion.names[11] + ")"));
  const int chin = motion_.motion.index_of("ibug68_8");
  Points far = Points::Zero(68, 3);
  far(chin, 1) = -0.16;
  EXPECT_THAT(said(far), testing::HasSubstr("point ibug68_8 is displaced by 160 mm: expected at "
                                            "most 150; displacements are in metres"));
  EXPECT_THAT(said(1e3 * open), testing::HasSubstr("displacements are in metres"));
  EXPECT_EQ(said(open), "") << "it goes on";
}

/// A change of the matrices' pattern, or of the set of prescribed unknowns, starts the stream
/// again.
TEST_F(SimulatorOfAFace, AStreamGoesOnWithAnotherElementAndOtherDrivenNodes) {
  const Points open = PointCurve(motion_, 1).at(0.3);
  SimulationOptions element = options_, patches = options_;
  element.model.element = fem::ElementKind::tet4;
  patches.drive.patch_radius_m = 0;
  for (const SimulationOptions& next : {element, patches}) {
    Simulator simulator = made(options_), anew = made(next);
    simulator.start_stream(1.0 / 30);
    simulator.step(open);
    simulator.set_options(next);
    anew.start_stream(1.0 / 30);
    EXPECT_EQ(simulator.step(open), anew.step(open));
  }
}

TEST_F(SimulatorOfAFace, AValueOutOfRangeChangesNothing) {
  Simulator simulator = made(options_);
  SupportOptions support = options_.support;
  support.field_pa_per_m = -1;
  EXPECT_THROW(simulator.set_support(support), InputError);
  EXPECT_EQ(simulator.options(), options_);
  options_.time.step_s = 0;
  EXPECT_THROW(made(options_), InputError);
}

TEST_F(SimulatorOfAFace, OfTheSkinAloneNothingElseIsMeasured) {
  const SimulationResult whole = made(options_).run();
  const SimulationResult skin =
      made(options_).run({.progress = {}, .cancelled = {}, .skin_alone = true});
  ASSERT_GT(whole.report.lip_gap_mm, 0);
  EXPECT_EQ(skin.report.lip_gap_mm, 0);
  EXPECT_EQ(skin.report.driven_off_mm, 0);
  for (std::size_t f = 0; f < whole.performance.skin_displacement_m.size(); ++f) {
    EXPECT_EQ(skin.performance.skin_displacement_m[f], whole.performance.skin_displacement_m[f]);
    EXPECT_EQ(skin.performance.landmarks.positions[f], whole.performance.landmarks.positions[f]);
  }
}

TEST_F(SimulatorOfAFace, TellsItsProgressAndCanBeCancelled) {
  options_.solver.method = SolverMethod::direct;
  Simulator simulator = made(options_);
  std::vector<double> shares;
  RunCallbacks callbacks;
  callbacks.progress = [&](double share) { shares.push_back(share); };
  const SimulationResult whole = simulator.run(callbacks);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.back(), 1);
  callbacks.cancelled = [&, asked = 0]() mutable { return ++asked == 10; };
  EXPECT_THROW(simulator.run(callbacks), Cancelled);
  expect_equal(simulator.run(), whole);
}

/// Finding the forces of a long recording takes minutes: each sample reports.
TEST_F(SimulatorOfAFace, TellsOfEachSampleWhoseForcesAreFound) {
  options_.drive.by = DriveBy::muscles;
  Simulator simulator = made(options_);
  simulator.run();
  SimulationOptions less = options_;  // the muscle model, which reports too, is kept
  less.drive.gain = 0.9;
  simulator.set_options(less);
  std::vector<double> shares;
  RunCallbacks callbacks;
  callbacks.progress = [&](double share) { shares.push_back(share); };
  simulator.run(callbacks);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  const auto samples = double(motion_.motion.time_s.size());
  for (int k = 1; k <= int(samples); ++k)
    EXPECT_TRUE(
        std::any_of(shares.begin(), shares.end(),
                    [&](double share) { return std::abs(share - 0.3 * k / samples) < 1e-12; }))
        << "sample " << k;
}

/// This holds for the reduced model too: in a long recording its frames take longer than its steps.
TEST_F(SimulatorOfAFace, TellsOfItsFramesAndCanBeCancelledAmongThem) {
  Simulator simulator = made(options_);
  std::vector<double> shares;
  RunCallbacks callbacks;
  const auto caller = std::this_thread::get_id();
  callbacks.progress = [&](double share) {
    EXPECT_EQ(std::this_thread::get_id(), caller);
    shares.push_back(share);
  };
  const SimulationResult whole = simulator.run(callbacks);
  ASSERT_GT(whole.report.basis_size, 0);
  EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
  EXPECT_EQ(shares.front(), 0);
  EXPECT_EQ(shares.back(), 1);
  EXPECT_GT(shares.size(), 6u);
  for (const double share : {0.3, 0.7, 0.85}) {  // where frames are stored and looked at
    callbacks.cancelled = [&] { return shares.back() > share; };
    shares = {0};
    EXPECT_THROW(simulator.run(callbacks), Cancelled);
    EXPECT_LT(shares.back(), 1) << "not run to the end; how soon depends on the machine";
  }
  expect_equal(simulator.run(), whole);
}

TEST_F(SimulatorOfAFace, AMatrixThatCannotBeFactoredLeavesItUsable) {
  Simulator simulator = made(options_);
  const SimulationResult before = simulator.run();
  SimulationOptions loose = options_;
  loose.drive.points = {"ibug68_8"};
  loose.drive.patch_radius_m = 0;
  loose.support = {.border_held = false,
                   .skull = Hold::free,
                   .mandible = Mandible::free,
                   .skull_layer = {},
                   .mandible_layer = {},
                   .field_pa_per_m = 0,
                   .jaw_points = {}};
  simulator.set_options(loose);
  try {
    simulator.run();
  } catch (const NumericalError&) {
  }
  simulator.set_options(options_);
  expect_equal(simulator.run(), before);
}

}  // namespace
}  // namespace hyperex::simulate
