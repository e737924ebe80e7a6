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
#include "simulate/option_cases.hpp"
#include "simulate/small_face.hpp"

namespace hyperex::simulate {
namespace {

using namespace test;

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
  /// Where muscles drive, the end of the run is an input of their forces.
  static OptionCase end_of_muscles() {
    OptionCase end = time_cases()[1];
    end.sources.push_back("end of muscles");
    return end;
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
                          end_of_muscles(), solver_cases()[1], solver_cases()[2],
                          surgery_cases()[0]});
  options_.time.end_s = 0.1;
  OptionCase step = time_cases()[0];
  step.sources.push_back("end of muscles");
  expect_as_declared(step);
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
                          end_of_muscles(),
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
  for (const auto* cases : {&model_cases(), &tissue_cases(), &support_cases(), &drive_cases(),
                            &region_cases(), &solver_cases(), &finite_solver_cases(),
                            &contact_cases(), &time_cases(), &muscle_cases(), &surgery_cases()})
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
  EXPECT_EQ(named({&surgery_cases()}, "surgery"), member_count<SurgeryOptions>());
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
