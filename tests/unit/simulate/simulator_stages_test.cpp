// SPDX-License-Identifier: GPL-3.0-or-later
// For each option that changes between two runs, the second run equals that of a new simulator, and
// computes exactly the stages that the declaration names.
#include "hyperex/simulate/run/simulator_stages.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>

#include "hyperex/core/progress.hpp"
#include "hyperex/face/face_frame.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

using Options = SimulationOptions;

/// An option, another value of it, and the parts of the options (OptionSource) that contain it.
struct OptionCase {
  std::string name;
  std::vector<std::string> sources;
  std::function<void(Options&)> change;
  std::optional<bool> has_effect = true;  ///< on where the face goes; empty: not checked
};

/// Another value within the bounds.
template <class Value>
Value another(Value value, const Bounds& bounds) {
  if constexpr (std::is_same_v<Value, bool>) return !value;
  for (const double other : {value + 1.0, value - 1.0, value * 1.25, value * 0.8, bounds.most / 2})
    if (bounds.holds(other) && Value(other) != value) return Value(other);
  throw std::logic_error("no other value is within the bounds");
}

/// Adds a case for each number and truth value of a section that no case names. So a new option is
/// tested without a line here: it is an input of the stages that its section is an input of. Other
/// types need a case, and so does an option that is a source of its own.
template <class Section>
struct AddDescribed {
  std::string section, source;
  Section Options::*member;
  std::vector<OptionCase> cases;

  template <class At>
  void option(const char* name, At at, const char*, const OptionDetails& details = {}) {
    using Value = std::remove_cvref_t<decltype(at(std::declval<Section&>()))>;
    if constexpr (std::is_arithmetic_v<Value>) {
      const std::string full = section + "." + name;
      if (std::ranges::count(cases, full, &OptionCase::name) > 0) return;
      const Section standard;
      const Value other = another<Value>(at(standard), details.bounds);
      cases.push_back({full,
                       {source},
                       [of = member, at, other](Options& o) { at(o.*of) = other; },
                       std::nullopt});
    }
  }
  template <class At, class AllAt>
  void one_or_all(const char*, At, const char*, AllAt, const char*) {}
  template <class At, class Words>
  void factors(const char*, At, const Words&, const char*, const OptionDetails&) {}
};
template <class Section>
std::vector<OptionCase> with_described(const std::string& section, const std::string& source,
                                       Section Options::*member, std::vector<OptionCase> cases) {
  AddDescribed<Section> add{section, source, member, std::move(cases)};
  Section::describe(add);
  return add.cases;
}

/// The stages (by name) with an input among `changed` or among the stages found so far. Stages
/// without a value pass nothing on. Checked stages count only where they are in `changed`
/// themselves.
std::set<std::string> resting_on(const StageGraph& graph, std::set<std::string> changed) {
  for (const Stage* stage : graph.stages()) {
    const std::string& name = stage->name();
    if (name == "prescribed unknowns" || name == "direction of the gains") continue;
    if (!stage->has_value()) continue;
    for (const Stage::Input& input : stage->inputs())
      if (changed.contains(input.stage->name())) changed.insert(name);
  }
  return changed;
}

class SimulatorStagesOfAFace : public testing::Test {
 protected:
  SimulatorStagesOfAFace() {
    Progress::silence(true);
    options_.time.step_s = 0.01;
    options_.drive.points = {"ibug68_48", "ibug68_54", "ibug68_51", "ibug68_57", "ibug68_8"};
  }
  ~SimulatorStagesOfAFace() override { Progress::silence(false); }

  Simulator made(const Options& options) const {
    Simulator out(mesh_, face_.landmarks, motion_, options);
    out.set_obstacles(obstacles_);
    return out;
  }
  static bool same(const SimulationResult& a, const SimulationResult& b) {
    return a.performance.skin_displacement_m == b.performance.skin_displacement_m &&
           a.performance.node_displacement_m == b.performance.node_displacement_m &&
           a.still_displacement_m == b.still_displacement_m;
  }
  static std::map<std::string, int> counts(const Simulator& simulator) {
    std::map<std::string, int> out;
    for (const Stage* stage : simulator.stages().stages()) out[stage->name()] = stage->computed();
    return out;
  }
  /// Runs, changes an option and runs again.
  void expect_as_declared(const OptionCase& option) const {
    SCOPED_TRACE(option.name);
    Options next = options_;
    option.change(next);
    Simulator simulator = made(options_), fresh = made(next);
    const SimulationResult first = simulator.run(), wanted = fresh.run();
    const auto before = counts(simulator), needed = counts(fresh);
    const auto order = simulator.elimination_order();
    std::set<std::string> changed(option.sources.begin(), option.sources.end());
    if (order && fresh.elimination_order() &&
        order->prescribed != fresh.elimination_order()->prescribed)
      changed.insert("prescribed unknowns");
    if (changed.contains("muscles.gain")) changed.insert("direction of the gains");
    const auto dropped = resting_on(simulator.stages(), changed);
    // Which places come near is known to runs alone.
    const auto may_drop = resting_on(simulator.stages(), {"places that come near"});
    simulator.set_options(next);
    const SimulationResult second = simulator.run();
    EXPECT_TRUE(same(second, wanted)) << "it differs from a fresh simulator's run";
    if (option.has_effect) {
      EXPECT_EQ(*option.has_effect, !same(first, second)) << "effect";
    }
    for (const auto& [stage, count] : counts(simulator)) {
      if (before.at(stage) == 0) continue;
      if (!dropped.contains(stage)) {
        if (may_drop.contains(stage)) continue;
        EXPECT_EQ(count, before.at(stage)) << stage << " was computed again, and names nothing "
                                           << "that changed";
      } else if (needed.at(stage) > 0) {
        EXPECT_EQ(count, before.at(stage) + 1) << stage << " names something that changed";
      }
    }
  }
  void expect_all_as_declared(const std::vector<OptionCase>& all) const {
    for (const OptionCase& option : all) expect_as_declared(option);
  }

  const test::SmallFace face_ = test::small_face();
  const std::shared_ptr<const tissue::TissueMesh> mesh_ =
      std::make_shared<const tissue::TissueMesh>(face_.mesh);
  AlignedMotion motion_ = test::mouth_opening(face_.landmarks, 10, 5, 30);
  std::shared_ptr<const std::vector<Obstacle>> obstacles_;
  Options options_;
};

// ----- the options, section by section

const OptionCase& case_of(const std::vector<OptionCase>& cases, const std::string& name) {
  return *std::ranges::find(cases, name, &OptionCase::name);
}

const std::vector<OptionCase>& model_cases() {
  static const std::vector<OptionCase> named = {
      {"model.element",
       {"model", "model.element"},
       [](Options& o) { o.model.element = fem::ElementKind::tet4; }},
      {"model.viscous_form",
       {"model"},
       [](Options& o) { o.model.viscous_form = fem::ViscousForm::printed; }},
      {"model.strain", {"model"}, [](Options& o) { o.model.strain = Strain::finite; }},
      {"model.law", {"model"}, [](Options& o) { o.model.law.c20 = 0.1; }, false}};
  static const auto cases = with_described("model", "model", &Options::model, named);
  return cases;
}

const std::vector<OptionCase>& tissue_cases() {
  static const std::vector<OptionCase> cases = {
      {"tissue.uniform", {"tissue"}, [](Options& o) { o.tissue.uniform[tissue::young] *= 3; }},
      {"tissue.uniform.density",
       {"tissue"},
       [](Options& o) { o.tissue.uniform[tissue::density] *= 3; }},
      {"tissue.uniform.viscosity",
       {"tissue"},
       [](Options& o) { o.tissue.uniform[tissue::viscosity] *= 30; }},
      {"tissue.uniform.poisson", {"tissue"}, [](Options& o) {
         o.tissue.uniform[tissue::poisson] = 0.3;
       }}};
  return cases;
}

const std::vector<OptionCase>& support_cases() {
  static const std::vector<OptionCase> named = {
      {"support.border_held", {"support"}, [](Options& o) { o.support.border_held = false; }},
      {"support.skull", {"support"}, [](Options& o) { o.support.skull = Hold::held; }},
      {"support.mandible", {"support"}, [](Options& o) { o.support.mandible = Mandible::free; }},
      {"support.skull_layer",
       {"support"},
       [](Options& o) { o.support.skull_layer.along_pa_per_m *= 3; }},
      {"support.mandible_layer",
       {"support"},
       [](Options& o) { o.support.mandible_layer.across_pa_per_m *= 3; }},
      {"support.field_pa_per_m", {"support"}, [](Options& o) { o.support.field_pa_per_m *= 2; }},
      {"support.teeth_layer",
       {"support"},
       [](Options& o) { o.support.teeth_layer.across_pa_per_m = 1e6; }},
      {"support.teeth_reach_m", {"support"}, [](Options& o) { o.support.teeth_reach_m = 0.02; }},
      {"support.throat_pa_per_m",
       {"support"},
       [](Options& o) { o.support.throat_pa_per_m = 2e6; },
       false},
      {"support.throat_reach_m",
       {"support"},
       [](Options& o) { o.support.throat_reach_m = 0.05; },
       false},
      {"support.jaw_points", {"support"}, [](Options& o) {
         o.support.jaw_points = {"ibug68_57"};
       }}};
  static const auto cases = with_described("support", "support", &Options::support, named);
  return cases;
}

const std::vector<OptionCase>& drive_cases() {
  static const std::vector<OptionCase> named = {
      {"drive.by",
       {"drive (not its gain)", "drive.by", "steps of reactions"},
       [](Options& o) { o.drive.by = DriveBy::reactions; }},
      {"drive.all_points", {"drive (not its gain)"}, [](Options& o) { o.drive.all_points = true; }},
      {"drive.points", {"drive (not its gain)"}, [](Options& o) { o.drive.points.pop_back(); }},
      {"drive.still_points",
       {"drive (not its gain)"},
       [](Options& o) { o.drive.still_points = {"ibug68_33"}; }},
      {"drive.patch_radius_m",
       {"drive (not its gain)"},
       [](Options& o) { o.drive.patch_radius_m = 0.02; }},
      {"drive.gain", {"drive.gain"}, [](Options& o) { o.drive.gain = 0.5; }}};
  static const auto cases = with_described("drive", "drive (not its gain)", &Options::drive, named);
  return cases;
}

const std::vector<OptionCase>& muscle_cases() {
  const std::string all = "muscles (not their gains)";
  using M = MuscleOptions;
  const auto scaled = [all](const char* name, double M::*member, bool has_effect = true) {
    return OptionCase{std::string("muscles.") + name,
                      {all},
                      [member](Options& o) { o.muscles.*member *= 0.8; },
                      has_effect};
  };
  static const std::vector<OptionCase> named = {
      {"muscles.own",
       {all},
       [](Options& o) {
         o.muscles.own = muscles::muscle_template();
         o.muscles.own.front().readiness *= 0.1;
         o.muscles.own.front().width_mm *= 2;
       }},
      {"muscles.gains",
       {"muscles.gain"},
       [](Options& o) {
         o.muscles.gains = {{"side_L", 0.5}};
       }},
      {"muscles.mirrored", {"muscles.gain"}, [](Options& o) { o.muscles.mirrored = true; }},
      {"muscles.skull_layer", {all}, [](Options& o) { o.muscles.skull_layer.along_pa_per_m *= 2; }},
      {"muscles.mandible_layer",
       {all},
       [](Options& o) { o.muscles.mandible_layer.across_pa_per_m *= 2; }},
      {"muscles.teeth_layer", {all}, [](Options& o) { o.muscles.teeth_layer.along_pa_per_m *= 2; }},
      scaled("lip_stiffening", &M::lip_stiffening),
      scaled("lip_reach_m", &M::lip_reach_m),
      scaled("foundation_pa_per_m", &M::foundation_pa_per_m),
      scaled("teeth_reach_m", &M::teeth_reach_m),
      scaled("throat_pa_per_m", &M::throat_pa_per_m, false),  // the face has no throat
      scaled("throat_reach_m", &M::throat_reach_m, false),
      {"muscles.shape", {all}, [](Options& o) { o.muscles.shape.band *= 0.8; }},
      {"muscles.fold", {all}, [](Options& o) { o.muscles.fold.width_mm *= 0.8; }},
      scaled("widening", &M::widening),
      scaled("half", &M::half),
      scaled("few_sigma_m", &M::few_sigma_m),
      scaled("many_sigma_m", &M::many_sigma_m, false),  // few points drive
      scaled("activation_sigma", &M::activation_sigma),
      scaled("ring_sigma", &M::ring_sigma),
      scaled("tone_sigma", &M::tone_sigma),
      scaled("slide_sigma_m", &M::slide_sigma_m),
      scaled("side_correlation", &M::side_correlation),
      scaled("many_patch_m", &M::many_patch_m, false),
      {"muscles.shape_prior", {all}, [](Options& o) { o.muscles.shape_prior = false; }},
      scaled("shape_sigma_m", &M::shape_sigma_m),
      scaled("shape_share", &M::shape_share),
      scaled("shape_smoothing_m", &M::shape_smoothing_m),
      scaled("shape_clear_m", &M::shape_clear_m),
      scaled("shape_reach_m", &M::shape_reach_m),
      scaled("few_cheek_share", &M::few_cheek_share),
      scaled("few_lip_share", &M::few_lip_share),
      scaled("many_muscle_share", &M::many_muscle_share, false),
      scaled("jaw_share", &M::jaw_share)};
  static const auto cases = with_described("muscles", all, &Options::muscles, named);
  return cases;
}

const std::vector<OptionCase>& region_cases() {
  static const std::vector<OptionCase> named = {
      {"region.measured", {"region"}, [](Options& o) { o.region.measured = Measured::all; }},
      {"region.measured_points",
       {"region"},
       [](Options& o) {
         o.region.measured_points = {"ibug68_8", "ibug68_7"};
       }},
      {"region.measured_radius_m",
       {"region"},
       [](Options& o) { o.region.measured_radius_m = 0.03; }},
      {"region.blend_m", {"region"}, [](Options& o) { o.region.blend_m = 0.02; }}};
  static const auto cases = with_described("region", "region", &Options::region, named);
  return cases;
}

const std::vector<OptionCase>& finite_solver_cases() {
  static const std::vector<OptionCase> cases = {
      {"solver.finite_step_s", {"solver"}, [](Options& o) { o.solver.finite_step_s = 0.05; }},
      {"solver.finite_tolerance", {"solver"}, [](Options& o) { o.solver.finite_tolerance = 1e-7; }},
      {"solver.full_newton", {"solver"}, [](Options& o) { o.solver.full_newton = true; }},
      {"model.law.c20", {"model"}, [](Options& o) {
         o.model.law.law = fem::HyperelasticLaw::yeoh;
       }}};
  return cases;
}

const std::vector<OptionCase>& solver_cases() {
  static const std::vector<OptionCase> named = {
      {"solver.method", {"solver"}, [](Options& o) { o.solver.method = SolverMethod::direct; }},
      {"solver.tolerance",
       {"solver", "solver.tolerance"},
       [](Options& o) { o.solver.tolerance = 1e-7; }},
      {"solver.newmark_beta",
       {"solver", "solver.newmark"},
       [](Options& o) { o.solver.newmark_beta = 0.4; }},
      {"solver.newmark_gamma",
       {"solver", "solver.newmark"},
       [](Options& o) { o.solver.newmark_beta = 0.4, o.solver.newmark_gamma = 0.7; }},
      {"solver.verify", {"solver"}, [](Options& o) { o.solver.verify = true; }, false}};
  static const auto cases = [] {
    std::vector<OptionCase> all = named;
    for (const OptionCase& option : finite_solver_cases()) all.push_back(option);
    all = with_described("solver", "solver", &Options::solver, all);
    all.erase(all.begin() + std::ptrdiff_t(named.size()),
              all.begin() + std::ptrdiff_t(named.size() + finite_solver_cases().size()));
    return all;
  }();
  return cases;
}

const std::vector<OptionCase>& contact_cases() {
  static const std::vector<OptionCase> named = {
      {"contact.lips", {"contact"}, [](Options& o) { o.contact.lips = false; }, false},
      {"contact.teeth",
       {"contact", "contact.teeth or eyes"},
       [](Options& o) { o.contact.teeth = false; }},
      {"contact.eyes",
       {"contact", "contact.teeth or eyes"},
       [](Options& o) { o.contact.eyes = true; },
       false},
      {"contact.patch_pa_per_m", {"contact"}, [](Options& o) { o.contact.patch_pa_per_m = 1e6; }},
      {"contact.point_give",
       {"contact"},
       [](Options& o) { o.contact.point_give = 50; },
       false}};  // displacements drive
  static const auto cases = with_described("contact", "contact", &Options::contact, named);
  return cases;
}

const std::vector<OptionCase>& time_cases() {
  static const std::vector<OptionCase> named = {
      {"time.step_s", {"time", "time.step_s"}, [](Options& o) { o.time.step_s = 0.005; }},
      {"time.end_s", {"time", "time.end_s"}, [](Options& o) { o.time.end_s = 0.1; }},
      {"time.frame_rate_hz", {"time"}, [](Options& o) { o.time.frame_rate_hz = 60; }},
      {"time.peak_time_s", {"time"}, [](Options& o) { o.time.peak_time_s = 0.05; }, false},
      {"time.still_times_s", {"time"}, [](Options& o) { o.time.still_times_s = {0.07}; }}};
  static const auto cases = with_described("time", "time", &Options::time, named);
  return cases;
}

// ----- tests

TEST_F(SimulatorStagesOfAFace, ModelAndTissueReachTheStagesThatNameThem) {
  expect_all_as_declared(model_cases());
  expect_all_as_declared(tissue_cases());
}

TEST_F(SimulatorStagesOfAFace, SupportReachesTheStagesThatNameIt) {
  options_.support.teeth_layer = {1e5, 1e5};
  options_.support.throat_pa_per_m = 1e6;
  expect_all_as_declared(support_cases());
}

TEST_F(SimulatorStagesOfAFace, DriveAndTimeReachTheStagesThatNameThem) {
  expect_all_as_declared(drive_cases());
  expect_all_as_declared(time_cases());
}

TEST_F(SimulatorStagesOfAFace, TheRegionReachesTheStagesThatNameIt) {
  options_.region.measured = Measured::points;
  options_.region.measured_points = {"ibug68_8"};
  expect_all_as_declared(region_cases());
}

TEST_F(SimulatorStagesOfAFace, TheSolverReachesTheStagesThatNameIt) {
  expect_all_as_declared(solver_cases());
  options_.solver.method = SolverMethod::direct;
  std::vector<OptionCase> direct;
  for (OptionCase option : solver_cases())
    if (option.name.starts_with("solver.newmark")) direct.push_back(option);
  direct.push_back(time_cases().front());
  direct.push_back(tissue_cases().front());
  direct.push_back(support_cases().front());
  expect_all_as_declared(direct);
}

TEST_F(SimulatorStagesOfAFace, FiniteStrainReachesTheStagesThatNameIt) {
  options_.model.strain = Strain::finite;
  options_.time.end_s = 0.07;
  expect_all_as_declared(finite_solver_cases());
}

TEST_F(SimulatorStagesOfAFace, MusclesReachTheStagesThatNameThem) {
  options_.drive.by = DriveBy::muscles;
  expect_all_as_declared(muscle_cases());
}

TEST_F(SimulatorStagesOfAFace, WhereMusclesDriveTheOtherSectionsReachTheirStages) {
  options_.drive.by = DriveBy::muscles;
  expect_all_as_declared({tissue_cases()[0], support_cases()[0],
                          case_of(drive_cases(), "drive.gain"), drive_cases()[2], time_cases()[0],
                          time_cases()[1], solver_cases()[1], solver_cases()[2]});
}

TEST_F(SimulatorStagesOfAFace, GainsReachWhatTheyAdd) {
  options_.drive.by = DriveBy::muscles;
  // What gains add is run on its own where it has at most half of the shapes of the whole motion:
  // one muscle, in a motion whose points move independently.
  motion_ = test::motion_of(face_.landmarks, 8, 30, [](const std::string&, const Vec3& at, int k) {
    return Vec3(2e-3 * std::min(1.0, k / 2.0) *
                Vec3(std::sin(k + 100 * at.x()), std::cos(2 * k + 90 * at.y()), 0));
  });
  options_.muscles.gains = {{"zyg_major_L", 0.5}};
  expect_all_as_declared({{"another muscle",
                           {"muscles.gain"},
                           [](Options& o) {
                             o.muscles.gains = {{"zyg_major_R", 0.5}};
                           }},
                          tissue_cases()[0],
                          solver_cases()[2],
                          time_cases()[1],
                          {"drive.gain", {"drive.gain"}, [](Options& o) { o.drive.gain = 0.7; }}});
}

TEST_F(SimulatorStagesOfAFace, ReactionsAreFoundAtTheStepsOfARun) {
  options_.drive.by = DriveBy::reactions;
  OptionCase tolerance = solver_cases()[1], step = time_cases()[0], end = time_cases()[1];
  for (OptionCase* option : {&tolerance, &step, &end})
    option->sources.push_back("steps of reactions");
  expect_all_as_declared(
      {tolerance, step, end, support_cases()[0], case_of(drive_cases(), "drive.gain")});
}

class SimulatorStagesInContact : public SimulatorStagesOfAFace {
 protected:
  /// The face is pressed onto a ball behind the mouth.
  SimulatorStagesInContact() {
    obstacles_ = ball(0.02);
    const Vec3 back = -face::face_frame(face_.landmarks).z;
    motion_ = test::motion_of(face_.landmarks, 5, 30, [&](const std::string&, auto&, int k) {
      return Vec3(0.003 * k / 4.0 * back);
    });
    options_.contact.teeth = options_.contact.lips = true;
  }
  /// A ball that nearly touches the tissue at rest.
  std::shared_ptr<const std::vector<Obstacle>> ball(double radius_m) const {
    const face::FaceFrame frame = face::face_frame(face_.landmarks);
    Vec3 centre = face_.landmarks.at("ibug68_62") - 2 * radius_m * frame.z;
    std::vector<Obstacle> all(1);
    for (int k = 0; k < 20; ++k) {
      const auto shape = std::make_shared<const SphereDistance>(centre, radius_m);
      all.front() = {Obstacle::Kind::teeth, shape, false};
      const ObstaclePlaces places(*mesh_, face_.landmarks, all.front());
      double least_m = 1;
      Vec3 outward;
      for (const Vec3& p : places.rest().rowwise())
        least_m = std::min(least_m, shape->at(p, outward));
      centre += (least_m - 5e-4) * frame.z;
    }
    return std::make_shared<const std::vector<Obstacle>>(std::move(all));
  }
};

TEST_F(SimulatorStagesInContact, ContactReachesTheStagesThatNameIt) {
  ASSERT_GT(made(options_).run().report.contact.frames, 0);
  expect_all_as_declared(contact_cases());
  expect_all_as_declared({tissue_cases()[0], support_cases()[0], drive_cases()[4], drive_cases()[2],
                          case_of(drive_cases(), "drive.gain"), model_cases()[0]});
  options_.drive.by = DriveBy::muscles;
  OptionCase give = case_of(contact_cases(), "contact.point_give");
  give.has_effect = true;
  expect_as_declared(give);
}

TEST_F(SimulatorStagesInContact, OtherObstaclesAreFound) {
  Simulator simulator = made(options_);
  const SimulationResult before = simulator.run();
  const auto others = ball(0.012);
  simulator.set_obstacles(others);
  const SimulationResult after = simulator.run();
  obstacles_ = others;
  EXPECT_TRUE(same(after, made(options_).run()));
  EXPECT_FALSE(same(before, after));
}

TEST_F(SimulatorStagesOfAFace, EqualOptionsKeepEveryStage) {
  Simulator simulator = made(options_);
  simulator.run();
  auto before = counts(simulator);
  simulator.set_options(options_);
  simulator.set_tissue(options_.tissue);
  simulator.set_support(options_.support);
  simulator.set_drive(options_.drive);
  simulator.set_obstacles(obstacles_);
  simulator.run();
  EXPECT_EQ(counts(simulator), before);
}

TEST_F(SimulatorStagesOfAFace, AHeldLoadOutlivesTissueAndSupportAndNothingElse) {
  options_.drive.by = DriveBy::muscles;
  Simulator simulator = made(options_);
  simulator.run();
  simulator.hold_load();
  Options next = options_;
  next.tissue.uniform[tissue::young] *= 2;
  next.support.border_held = false;
  next.model.element = fem::ElementKind::tet4;
  simulator.set_options(next);
  simulator.run();
  EXPECT_EQ(counts(simulator).at("load"), 1);
  next.drive.gain = 0.5;
  simulator.set_options(next);
  simulator.run();
  EXPECT_EQ(counts(simulator).at("load"), 2);
}

TEST_F(SimulatorStagesOfAFace, ACopyComputesOnlyWhatChangesAsItIsUsed) {
  options_.drive.by = DriveBy::muscles;
  Simulator simulator = made(options_);
  const SimulationResult first = simulator.run();
  Simulator copy = simulator;
  EXPECT_TRUE(same(copy.run(), first));
  std::set<std::string> computed;
  for (const auto& [name, count] : counts(copy))
    if (count > 0) computed.insert(name);
  EXPECT_THAT(computed, testing::ElementsAre("factor", "reduced motion"));
}

/// Each option is in a part of the options that some stage has as an input, so that no change goes
/// unnoticed.
TEST(SimulatorStages, EveryOptionIsAnInputOfSomeStage) {
  const SimulatorStages stages;
  for (const auto* cases :
       {&model_cases(), &tissue_cases(), &support_cases(), &drive_cases(), &region_cases(),
        &solver_cases(), &finite_solver_cases(), &contact_cases(), &time_cases(), &muscle_cases()})
    for (const OptionCase& option : *cases) {
      Options before, now;
      // Muscles have an effect where they drive.
      if (option.name.starts_with("muscles.")) before.drive.by = now.drive.by = DriveBy::muscles;
      if (option.name == "contact.lips" || option.name == "contact.teeth")
        before.contact.lips = before.contact.teeth = now.contact.lips = now.contact.teeth = true;
      option.change(now);
      std::vector<std::string> sources;
      for (const Stage* stage : stages.stages())
        if (const auto* source = dynamic_cast<const OptionSource*>(stage);
            source && !source->equal(before, now))
          sources.push_back(source->name());
      EXPECT_THAT(sources, testing::UnorderedElementsAreArray(option.sources)) << option.name;
    }
}

struct AnyValue {
  template <class T>
  operator T() const;
};
/// The number of members of a struct without a base class.
template <class T, class... Values>
constexpr std::size_t member_count() {
  if constexpr (requires { T{Values{}..., AnyValue{}}; })
    return member_count<T, Values..., AnyValue>();
  else
    return sizeof...(Values);
}

/// The lists above name every member, so that a new option is not forgotten.
TEST(SimulatorStages, TheCasesNameEveryOption) {
  const auto named = [](std::initializer_list<const std::vector<OptionCase>*> all,
                        const std::string& section) {
    std::set<std::string> names;
    for (const auto* cases : all)
      for (const OptionCase& option : *cases)
        if (option.name.starts_with(section + "."))
          names.insert(option.name.substr(0, option.name.find('.', section.size() + 1)));
    return names.size();
  };
  EXPECT_EQ(named({&model_cases()}, "model"), member_count<ModelOptions>());
  EXPECT_EQ(named({&support_cases()}, "support"), member_count<SupportOptions>());
  EXPECT_EQ(named({&drive_cases()}, "drive"), member_count<DriveOptions>());
  EXPECT_EQ(named({&muscle_cases()}, "muscles"), member_count<MuscleOptions>());
  EXPECT_EQ(named({&region_cases()}, "region"), member_count<RegionOptions>());
  EXPECT_EQ(named({&solver_cases(), &finite_solver_cases()}, "solver"),
            member_count<SolverOptions>());
  EXPECT_EQ(named({&contact_cases()}, "contact"), member_count<ContactOptions>());
  EXPECT_EQ(named({&time_cases()}, "time"), member_count<TimeOptions>());
}

/// The table in simulator.hpp is the declaration in words.
TEST(SimulatorStages, TheHeadersTableIsTheDeclaration) {
  std::ifstream file(std::string(HYPEREX_SOURCE_DIR) + "/src/hyperex/simulate/run/simulator.hpp");
  std::vector<std::pair<std::string, std::string>> table;
  std::size_t second_column = 0;
  const auto trimmed = [](const std::string& cell) {
    const auto from = cell.find_first_not_of(' ');
    return from == std::string::npos ? ""
                                     : cell.substr(from, cell.find_last_not_of(' ') + 1 - from);
  };
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("///   stage ")) {
      second_column = line.find("computed from");
    } else if (second_column > 0) {
      if (line == "///") break;
      ASSERT_GT(line.size(), second_column) << line;
      const std::string stage = trimmed(line.substr(3, second_column - 3));
      const std::string inputs = trimmed(line.substr(second_column));
      if (stage.empty())
        table.back().second += " " + inputs;
      else
        table.emplace_back(stage, inputs);
    }
  }
  std::vector<std::pair<std::string, std::string>> declared;
  const SimulatorStages stages;
  for (const Stage* stage : stages.stages()) {
    if (dynamic_cast<const Source*>(stage)) continue;
    const std::string inputs = stage->inputs_in_words();
    declared.emplace_back(stage->name(), inputs.empty() ? "-" : inputs);
  }
  EXPECT_EQ(table, declared);
}

}  // namespace
}  // namespace hyperex::simulate
