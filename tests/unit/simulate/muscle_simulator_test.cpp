// SPDX-License-Identifier: GPL-3.0-or-later
// A simulator driven by forces: their result in the tissue in which they were found, and in other
// tissue or with weaker muscles.
#include <gmock/gmock.h>

#include <map>

#include "hyperex/core/error.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/muscles/muscle_template.hpp"
#include "hyperex/simulate/load/muscle_load.hpp"
#include "hyperex/simulate/run/simulator.hpp"
#include "simulate/small_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::simulate {
namespace {

/// A smile, held at the end; its right half is `right` times its left one.
AlignedMotion smile(const io::Landmarks& landmarks, double right) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  return test::motion_of(
      landmarks, 16, 30, [&](const std::string& name, const Vec3&, int k) -> Vec3 {
        const double t = std::min(1.0, k / 10.0), course = t * t * (3 - 2 * t);
        const double side = name == "ibug68_54" ? 1 : name == "ibug68_48" ? -1 : 0;
        if (side == 0) return Vec3::Zero();
        const Vec3 way = side * 0.005 * frame.x + 0.004 * frame.y - 0.002 * frame.z;
        return course * (side > 0 ? 1 : right) * way;
      });
}

/// That smile, which is held; from 0.7 s on the mouth opens wide.
AlignedMotion smile_then_opening(const io::Landmarks& landmarks) {
  const face::FaceFrame frame = face::face_frame(landmarks);
  const AlignedMotion smiling = smile(landmarks, 1);
  const auto opens = [](const std::string& name) {
    return name == "ibug68_57" || name == "ibug68_8";
  };
  return test::motion_of(
      landmarks, 76, 30, [&](const std::string& name, const Vec3& rest, int k) -> Vec3 {
        const int row = smiling.motion.index_of(name);
        const Vec3 smiled =
            smiling.motion.positions[std::size_t(std::min(k, 15))].row(row).transpose() - rest;
        const double t = std::clamp((k - 21) / 20.0, 0.0, 1.0);
        return smiled - (opens(name) ? 0.015 * t * t * (3 - 2 * t) : 0.0) * frame.y;
      });
}

class DrivenByForces : public testing::Test {
 protected:
  DrivenByForces() {
    options_.time.step_s = 0.01;
    options_.drive.by = DriveBy::muscles;
    options_.drive.points = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57", "ibug68_8"};
  }
  Simulator made(const SimulationOptions& options, double right = 1) const {
    return Simulator(mesh_, face_.landmarks, smile(face_.landmarks, right), options);
  }
  /// Way of a landmark at the last frame, m.
  static double way(const SimulationResult& result, const std::string& name) {
    const auto& tracks = result.performance.landmarks;
    const auto row =
        std::find(tracks.names.begin(), tracks.names.end(), name) - tracks.names.begin();
    return (tracks.positions.back().row(row) - tracks.positions.front().row(row)).norm();
  }
  TissueValues stiffer(double factor, const std::function<bool(const Vec3&)>& where) const {
    const face::FaceFrame frame = face::face_frame(face_.landmarks);
    TissueValues out = options_.tissue;
    const auto& volume = mesh_->volume;
    for (int p = 0; p < tissue::parameter_count; ++p)
      out.element[p].assign(std::size_t(volume.tets.rows()), out.uniform[p]);
    for (Eigen::Index t = 0; t < volume.tets.rows(); ++t) {
      Vec3 centre = Vec3::Zero();
      for (int a = 0; a < 4; ++a) centre += 0.25 * volume.nodes.row(volume.tets(t, a)).transpose();
      if (where(frame.local(centre))) out.element[tissue::young][std::size_t(t)] *= factor;
    }
    return out;
  }
  static float apart(const SimulationResult& a, const SimulationResult& b) {
    float most = 0;
    for (std::size_t f = 0; f < a.performance.skin_displacement_m.size(); ++f)
      most = std::max(most,
                      (a.performance.skin_displacement_m[f] - b.performance.skin_displacement_m[f])
                          .rowwise()
                          .norm()
                          .maxCoeff());
    return most;
  }

  const test::SmallFace face_ = test::small_face();
  const std::shared_ptr<const tissue::TissueMesh> mesh_ =
      std::make_shared<const tissue::TissueMesh>(face_.mesh);
  SimulationOptions options_;
};

TEST_F(DrivenByForces, MusclesMeetTheDrivenPoints) {
  const SimulationResult result = made(options_).run();
  EXPECT_LT(result.report.driven_off_mm, 0.12);
  EXPECT_GT(way(result, "ibug68_54"), 0.005);
  const MuscleCourse& muscles = result.performance.muscles;
  ASSERT_EQ(muscles.names.size(), 52u);
  EXPECT_EQ(muscles.activation.rows(), 52);
  EXPECT_TRUE(muscles.few_points);
  EXPECT_EQ(muscles.activation.cols(), 16);
  EXPECT_EQ(muscles.sigma.cols(), 16);
  ASSERT_EQ(muscles.prior_sigma.cols(), 16);
  EXPECT_GE((muscles.prior_sigma - muscles.sigma).minCoeff(), -1e-12) << "points tell nothing less";
  ASSERT_EQ(muscles.group_prior_sigma.rows(), Eigen::Index(muscles.groups.size()));
  EXPECT_GE((muscles.group_prior_sigma - muscles.group_sigma).minCoeff(), -1e-12);
  const Eigen::ArrayXd determined =
      1 - (muscles.sigma.col(15).array() / muscles.prior_sigma.col(15).array()).square();
  EXPECT_GT(determined.maxCoeff(), 0.5) << "corners of the mouth show some muscles";
  EXPECT_LT(determined.minCoeff(), 0.05) << "and not those of the brows";
  EXPECT_EQ(muscles.time_s.size(), 16u);
  EXPECT_EQ(muscles.jaw_opening_deg.size(), 16);
  EXPECT_EQ(muscles.activation.col(0).cwiseAbs().maxCoeff(), 0) << "at rest";
}

/// In the patches the solution lies between the shape of the muscles in the tissue and the field
/// between the points. With shares of 0 it is that field, as in the patches of prescribed
/// displacements.
TEST_F(DrivenByForces, PatchesAreAMixtureOfTissueAndField) {
  options_.muscles.own = muscles::muscle_template();
  for (muscles::TemplateMuscle& muscle : options_.muscles.own) muscle.few_share = -1;
  options_.muscles.shape_prior = false;  // it acts between the points, in the patches too
  const SimulationOptions plain = options_;
  options_.drive.by = DriveBy::displacement;
  const SimulationResult field = made(options_).run();
  std::map<double, SimulationResult> by_share;
  for (const double share : {0.0, 0.25, 1.0}) {
    options_ = plain;
    options_.muscles.few_cheek_share = options_.muscles.few_lip_share = options_.muscles.jaw_share =
        share;
    options_.muscles.many_muscle_share = 7;  // not of these five points
    by_share.emplace(share, made(options_).run());
    EXPECT_LT(by_share.at(share).report.driven_off_mm, 0.12) << share;
  }
  const auto peak = [](const SimulationResult& r) {
    return r.performance.skin_displacement_m.back().cast<double>().eval();
  };
  const Points none = peak(by_share.at(0)), some = peak(by_share.at(0.25)),
               all = peak(by_share.at(1));
  EXPECT_LT((some - (0.75 * none + 0.25 * all)).rowwise().norm().maxCoeff(), 2e-5);
  // Within the patch of the left corner; the field's own and not the muscles' shape there.
  const Points& rest = field.performance.skin_rest.points;
  const Vec3 corner = face_.landmarks.at("ibug68_54");
  double off_none = 0, off_all = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    if ((rest.row(v).transpose() - corner).norm() > options_.drive.patch_radius_m) continue;
    if (mesh_->upper_margin[std::size_t(v)] < 0) continue;  // of one lip
    off_none = std::max(off_none, (none - peak(field)).row(v).norm());
    off_all = std::max(off_all, (all - peak(field)).row(v).norm());
  }
  EXPECT_LT(off_none, 1e-4);
  EXPECT_GT(off_all, 5 * off_none);
  EXPECT_EQ(by_share.at(0).performance.muscles.activation,
            by_share.at(1).performance.muscles.activation)
      << "the points are where they were";
}

/// Around the chin's patch, the skin is held less and less firmly. So it returns there from the
/// field between the points to the tissue's own displacement.
TEST_F(DrivenByForces, TheChinsPatchLetsGoTowardsItsEdge) {
  options_.muscles.shape_prior = false;
  const auto peak = [&](double share) {
    options_.muscles.few_cheek_share = options_.muscles.few_lip_share = options_.muscles.jaw_share =
        share;
    return made(options_).run().performance.skin_displacement_m.back().cast<double>().eval();
  };
  options_.muscles.own = muscles::muscle_template();
  for (muscles::TemplateMuscle& muscle : options_.muscles.own) muscle.few_share = -1;
  const Eigen::VectorXd mixed = (peak(0) - peak(1)).rowwise().norm();
  const Points& rest = mesh_->volume.outer.points;
  double inside = 0, edge = 0;
  for (Eigen::Index v = 0; v < rest.rows(); ++v) {
    const auto away = [&](const std::string& point) {
      return (rest.row(v).transpose() - face_.landmarks.at(point)).norm();
    };
    if (std::any_of(options_.drive.points.begin(), options_.drive.points.end(),
                    [&](const std::string& p) { return p != "ibug68_8" && away(p) < 0.020; }))
      continue;
    if (const double d = away("ibug68_8"); d < 0.020)
      inside = std::max(inside, mixed[v]);
    else if (d > 0.025 && d < 0.032 && mesh_->upper_margin[std::size_t(v)] <= 0)
      edge = std::max(edge, mixed[v]);
  }
  EXPECT_GT(edge, 0);
  EXPECT_LT(edge, 0.9 * inside) << "1.04 of it where all of the patch is held exactly";
}

TEST_F(DrivenByForces, AMuscleMayHaveAShareOfItsOwn) {
  const auto peak = [&](double of_all, double of_zygomaticus) {
    options_.muscles.own = muscles::muscle_template();
    for (muscles::TemplateMuscle& muscle : options_.muscles.own)
      muscle.few_share = muscle.name == "zyg_major" ? of_zygomaticus : -1;
    options_.muscles.few_cheek_share = options_.muscles.few_lip_share = of_all;
    return made(options_).run().performance.skin_displacement_m.back().cast<double>().eval();
  };
  const auto most = [](const Points& p) { return p.rowwise().norm().maxCoeff(); };
  const Points as_all = peak(0.5, -1);
  EXPECT_EQ(most(peak(0.5, 0.5) - as_all), 0);
  EXPECT_GT(most(peak(0.5, 0) - as_all), 1e-5);
}

TEST_F(DrivenByForces, CheekLipsAndJawEachHaveTheirShareOfThePatches) {
  const auto peak = [&](double cheek, double lip, double jaw) {
    options_.muscles.few_cheek_share = cheek;
    options_.muscles.few_lip_share = lip;
    options_.muscles.jaw_share = jaw;
    return made(options_).run().performance.skin_displacement_m.back().cast<double>().eval();
  };
  const auto most = [](const Points& p) { return p.rowwise().norm().maxCoeff(); };
  const Points none = peak(0, 0, 0), all = peak(1, 1, 1);
  const Points cheek = peak(1, 0, 0) - none, lip = peak(0, 1, 0) - none, jaw = peak(0, 0, 1) - none;
  for (const Points& alone : {cheek, lip, jaw}) EXPECT_GT(most(alone), 1e-5);
  EXPECT_LT(most(none + cheek + lip + jaw - all), 2e-5);
  EXPECT_GT(most(cheek - lip), 1e-5);
}

TEST_F(DrivenByForces, ReactionsMoveTheFaceAsTheDisplacementsDid) {
  options_.drive.by = DriveBy::displacement;
  const SimulationResult prescribed = made(options_).run();
  options_.drive.by = DriveBy::reactions;
  const SimulationResult by_forces = made(options_).run();
  EXPECT_LT(apart(prescribed, by_forces), 1e-4);
  EXPECT_TRUE(by_forces.performance.muscles.names.empty());
  EXPECT_EQ(by_forces.report.driven_nodes, 0);
}

TEST_F(DrivenByForces, HeldForcesMoveStifferTissueLess) {
  for (const DriveBy by : {DriveBy::muscles, DriveBy::reactions}) {
    options_.drive.by = by;
    const TissueValues stiff = stiffer(2, [](const Vec3&) { return true; });
    Simulator base = made(options_);
    const double before = way(base.run(), "ibug68_54");
    Simulator found_anew = base, held = base;
    found_anew.set_tissue(stiff);
    const SimulationResult anew = found_anew.run();
    EXPECT_NEAR(way(anew, "ibug68_54"), before, 1e-4) << "the points are met again";
    if (by == DriveBy::muscles) {
      EXPECT_LT(anew.report.driven_off_mm, 0.1);
    }
    held.hold_load();
    held.set_tissue(stiff);
    const double after = way(held.run(), "ibug68_54");
    EXPECT_LT(after, 0.9 * before);
    EXPECT_GT(after, 0.3 * before);
    held.set_tissue(options_.tissue);
    EXPECT_NEAR(way(held.run(), "ibug68_54"), before, 1e-6) << "and back";
    Simulator copy = held;  // holds the same forces
    copy.set_tissue(stiff);
    EXPECT_EQ(way(copy.run(), "ibug68_54"), after);
  }
}

/// Without the note, a sweep over stiffness would give equal results without an explanation.
TEST_F(DrivenByForces, ForcesFoundAnewInOtherTissueAreNoted) {
  const auto noted = [](const SimulationResult& result) {
    const auto& notes = result.report.notes;
    const bool there = std::count_if(notes.begin(), notes.end(), [](const Note& note) {
                         return note.id == "forces.found_anew";
                       }) == 1;
    EXPECT_EQ(there, result.report.forces_found_anew);
    return there;
  };
  TissueValues soft = options_.tissue;
  soft.uniform[tissue::young] *= 0.5;
  for (const DriveBy by : {DriveBy::muscles, DriveBy::reactions}) {
    options_.drive.by = by;
    Simulator simulator = made(options_);
    simulator.set_tissue(soft);
    EXPECT_FALSE(noted(simulator.run())) << "the first run";
    EXPECT_FALSE(noted(simulator.run())) << "nothing was changed";
    simulator.set_tissue(options_.tissue);
    Simulator copy = simulator;
    EXPECT_TRUE(noted(simulator.run()));
    EXPECT_TRUE(noted(copy.run()));
    SupportOptions looser = options_.support;
    looser.skull_layer.across_pa_per_m *= 0.5;
    simulator.set_support(looser);
    EXPECT_TRUE(noted(simulator.run()));
    EXPECT_FALSE(noted(simulator.run())) << "as the run before";
    simulator.set_tissue(soft);
    simulator.set_motion(smile(face_.landmarks, 0.5));
    EXPECT_FALSE(noted(simulator.run())) << "another motion asks for other forces";
    simulator.hold_load();
    simulator.set_tissue(options_.tissue);
    EXPECT_FALSE(noted(simulator.run())) << "held";
  }
  options_.drive.by = DriveBy::displacement;
  Simulator simulator = made(options_);
  simulator.run();
  simulator.set_tissue(soft);
  EXPECT_FALSE(noted(simulator.run())) << "no forces";
}

/// The muscles' effect on the face is computed once for several motions, and again for other
/// tissue, support or muscles. This must not change any number.
TEST_F(DrivenByForces, AnotherMotionAnswersAsASimulatorMadeWithIt) {
  Simulator simulator = made(options_, 1);
  simulator.run();
  const auto another = [&](const SimulationOptions& options) {
    Simulator copy = simulator;
    copy.set_motion(smile(face_.landmarks, 0.3));
    copy.set_options(options);
    return apart(copy.run(), made(options, 0.3).run());
  };
  EXPECT_EQ(another(options_), 0);
  SimulationOptions other = options_;
  other.tissue.uniform[tissue::young] *= 2;
  EXPECT_EQ(another(other), 0);
  other = options_;
  other.support.border_held = false;
  EXPECT_EQ(another(other), 0);
  other = options_;
  other.muscles.widening = 1.5;
  EXPECT_EQ(another(other), 0);
  other = options_;
  other.model.element = fem::ElementKind::tet4;
  EXPECT_EQ(another(other), 0);
}

TEST_F(DrivenByForces, AStiffLeftCheekChangesTheLeftCorner) {
  Simulator simulator = made(options_, 0);
  const SimulationResult before = simulator.run();
  simulator.hold_load();
  simulator.set_tissue(stiffer(4, [](const Vec3& p) { return p.x() > 0.015; }));
  const SimulationResult after = simulator.run();
  const auto change = [&](const char* name) {
    const auto& tracks = before.performance.landmarks;
    const auto row =
        std::find(tracks.names.begin(), tracks.names.end(), name) - tracks.names.begin();
    return (after.performance.landmarks.positions.back().row(row) -
            tracks.positions.back().row(row))
        .norm();
  };
  EXPECT_LT(way(after, "ibug68_54"), way(before, "ibug68_54"));
  EXPECT_GT(change("ibug68_54"), 5e-4);
  EXPECT_LT(change("ibug68_48"), 0.15 * change("ibug68_54"));
}

TEST_F(DrivenByForces, AWeakerMuscleMovesLess) {
  Simulator simulator = made(options_);
  const SimulationResult before = simulator.run();
  const MuscleCourse& muscles = before.performance.muscles;
  Eigen::Index m = 0;
  muscles.activation.rightCols(1).col(0).maxCoeff(&m);
  const std::string name = muscles.names[std::size_t(m)];
  const std::string corner = name.back() == 'L' ? "ibug68_54" : "ibug68_48";
  const std::string other = name.back() == 'L' ? "ibug68_48" : "ibug68_54";
  SimulationOptions weak = options_;
  weak.muscles.gains = {{name, 0.6}};
  simulator.set_options(weak);
  simulator.run();
  weak.muscles.gains = {{name, 0.3}};
  simulator.set_options(weak);
  const SimulationResult after = simulator.run();
  EXPECT_LT(way(after, corner), 0.95 * way(before, corner));
  EXPECT_GT(way(after, other), 0.97 * way(before, other));
  EXPECT_LT((after.performance.muscles.activation.row(m) - 0.3 * muscles.activation.row(m)).norm(),
            1e-12);
  EXPECT_EQ(apart(after, made(weak).run()), 0) << "as a simulator made with it";
  EXPECT_GT(after.report.basis_size, before.report.basis_size)
      << "what one muscle loses is added to the run as recorded";
  weak.solver.verify = true;
  const SimulationResult checked = made(weak).run();
  EXPECT_LT(checked.report.verified_error, weak.solver.tolerance);
  EXPECT_GT(checked.report.verified_error, 0);
  // Gains do not find new forces: back to 1, all is as before.
  simulator.set_options(options_);
  EXPECT_EQ(apart(simulator.run(), before), 0);
}

/// Neither do forces that no muscle explains: they fade with all muscles that may make them.
TEST_F(DrivenByForces, WithoutMusclesOnASideItsCornerHardlyMoves) {
  Simulator simulator = made(options_);
  const SimulationResult before = simulator.run();
  SimulationOptions palsy = options_;
  palsy.muscles.gains = {{"side_L", 0}};
  simulator.set_options(palsy);
  const SimulationResult after = simulator.run();
  EXPECT_LT(way(after, "ibug68_54"), 0.2 * way(before, "ibug68_54"));
  EXPECT_GT(way(after, "ibug68_48"), 0.95 * way(before, "ibug68_48"));
}

TEST_F(DrivenByForces, AGainOf1ChangesNoBit) {
  const SimulationResult before = made(options_).run();
  options_.muscles.gains = {{"side_L", 1}, {"zyg_major_R", 1}};
  EXPECT_EQ(apart(made(options_).run(), before), 0);
}

TEST_F(DrivenByForces, MirroredMusclesMirrorTheMotion) {
  Simulator simulator = made(options_, 0.2);
  const SimulationResult before = simulator.run();
  options_.muscles.mirrored = true;
  simulator.set_options(options_);
  const SimulationResult after = simulator.run();
  EXPECT_LT(way(after, "ibug68_54"), way(before, "ibug68_54"));
  EXPECT_GT(way(after, "ibug68_48"), way(before, "ibug68_48"));
}

TEST_F(DrivenByForces, ADriveChangedIsAsOneMadeWithIt) {
  Simulator simulator = made(options_);
  simulator.run();
  for (const auto& change : std::vector<std::function<void(SimulationOptions&)>>{
           [](auto& o) { o.drive.by = DriveBy::displacement; },
           [](auto& o) { o.drive.by = DriveBy::reactions; }, [](auto& o) { o.time.step_s = 0.005; },
           [](auto& o) { o.drive.by = DriveBy::muscles; },
           [](auto& o) { o.muscles.lip_stiffening = 1; }, [](auto& o) { o.drive.gain = 0.5; },
           [](auto& o) { o.support.border_held = false; },
           [](auto& o) { o.model.element = fem::ElementKind::tet4; },
           [](auto& o) { o.tissue.uniform[tissue::young] *= 2; }}) {
    change(options_);
    simulator.set_options(options_);
    EXPECT_EQ(apart(simulator.run(), made(options_).run()), 0);
  }
}

TEST_F(DrivenByForces, APartOfAMotionTellsNothingOfTheRest) {
  const AlignedMotion motion = smile_then_opening(face_.landmarks);
  options_.solver.tolerance = 1e-5;
  const SimulationResult whole = Simulator(mesh_, face_.landmarks, motion, options_).run();
  options_.time.end_s = 0.5;
  const SimulationResult part = Simulator(mesh_, face_.landmarks, motion, options_).run();
  const MuscleCourse& muscles = part.performance.muscles;
  ASSERT_EQ(muscles.time_s.size(), 16u);
  EXPECT_DOUBLE_EQ(muscles.time_s.back(), 0.5);
  EXPECT_EQ(muscles.activation.cols(), 16);
  EXPECT_EQ(muscles.sigma.cols(), 16);
  EXPECT_EQ(muscles.prior_sigma.cols(), 16);
  EXPECT_EQ(muscles.group_activation.cols(), 16);
  EXPECT_EQ(muscles.jaw_opening_deg.size(), 16);
  EXPECT_EQ(muscles.activation, whole.performance.muscles.activation.leftCols(16));
  EXPECT_LT(part.report.greatest_opening_deg, 0.5 * whole.report.greatest_opening_deg);
  // The face moves as before: to what the forces are compressed to.
  const auto& frames = part.performance.skin_displacement_m;
  ASSERT_EQ(frames.size(), 16u);
  float off = 0;
  for (std::size_t f = 0; f < frames.size(); ++f)
    off = std::max(
        off, (frames[f] - whole.performance.skin_displacement_m[f]).rowwise().norm().maxCoeff());
  EXPECT_LT(off, 5e-5F);
}

TEST(SamplesOfRun, AreThoseOfTheRunAndOfTheCurveAtItsEnd) {
  std::vector<double> time_s;
  for (int k = 0; k < 76; ++k) time_s.push_back(2 + k / 30.0);
  TimeOptions time;
  time.step_s = 0.01;
  EXPECT_EQ(samples_of_run(time_s, time), 76) << "no end";
  time.end_s = 0.5;
  EXPECT_EQ(samples_of_run(time_s, time), 19 + 16);
  time.end_s = 2.4;
  EXPECT_EQ(samples_of_run(time_s, time), 76);
  time.end_s = 60;
  EXPECT_EQ(samples_of_run(time_s, time), 76);
}

TEST_F(DrivenByForces, HeldForcesOfAPartMoveThatPartAlone) {
  options_.time.end_s = 0.5;
  Simulator simulator(mesh_, face_.landmarks, smile_then_opening(face_.landmarks), options_);
  simulator.run();
  simulator.hold_load();
  options_.time.end_s = 0.4;
  simulator.set_options(options_);
  EXPECT_DOUBLE_EQ(simulator.run().performance.muscles.time_s.back(), 0.4);
  options_.time.end_s = 0.6;
  simulator.set_options(options_);
  EXPECT_THAT(hyperex::test::refusal([&] { simulator.run(); }),
              testing::HasSubstr("the held forces are those of a run of 0.5 s"));
  EXPECT_THROW(simulator.still(0.6), InputError);
}

TEST_F(DrivenByForces, MeasuredRegionsAndStreamsAreRefused) {
  options_.region.measured = Measured::points;
  options_.region.measured_points = {"ibug68_8"};
  EXPECT_THROW(made(options_).run(), InputError);
  options_.region = {};
  EXPECT_THROW(made(options_).start_stream(0.03), InputError);
  options_.muscles.gains = {{"masseter_L", 0.5}};
  EXPECT_THROW(made(options_).run(), InputError);
  options_.muscles.gains = {{"side_L", -0.1}};
  EXPECT_THROW(made(options_), InputError);
}

}  // namespace
}  // namespace hyperex::simulate
