// SPDX-License-Identifier: GPL-3.0-or-later
// Recorded expressions move a face model whose head is still: no part of their motion may be
// attributed to the head.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <utility>
#include <vector>

#include "hyperex/motion/rest.hpp"
#include "hyperex/report/face_backing.hpp"
#include "hyperex/session/face_session.hpp"
#include "hyperex/session/inputs.hpp"
#include "hyperex/session/reading_warnings.hpp"
#include "support/note_matchers.hpp"
#include "unit/scene/scene_files.hpp"

namespace hyperex::session {
using namespace scene;
namespace {

TEST(Expressions, LeaveTheHeadWhereItIs) {
  const Inputs in = read_inputs(read_scene(HYPEREX_SOURCE_DIR "/examples/one_sided_smile.toml"));
  EXPECT_EQ(in.head_shift_uncertainty_mm, 0);
  EXPECT_EQ(in.head_turn_uncertainty_deg, 0);
  const auto& motion = in.motion.motion;
  const auto travel_m = [&](const char* name) {
    const int row = motion.index_of(name);
    double most = 0;
    for (const Points& at : motion.positions)
      most = std::max(most, (at.row(row) - motion.positions.front().row(row)).norm());
    return most;
  };
  // The smile is on the right: the left eye's corners and the bridge of the nose do not move.
  for (const char* name : {"ibug68_42", "ibug68_45", "ibug68_27"})
    EXPECT_LT(travel_m(name), 2e-4) << name;
  EXPECT_GT(travel_m("ibug68_48"), 0.01);
}

/// A jaw that opens by 0.3 within half a second, at 60 Hz; from sample 20 on its weight is wrong.
Inputs with_wrong_jaw(const std::vector<double>& wrong) {
  const SceneFolder folder;
  std::string text = "time_s,jawOpen\n";
  for (int k = 0; k < 60; ++k)
    text += fmt::format("{},{}\n", k / 60.0,
                        k >= 20 && k < 20 + int(wrong.size()) ? wrong[std::size_t(k - 20)]
                                                              : std::min(0.3, 0.01 * k));
  folder.write("jaw.csv", text);
  return read_inputs(read_scene(
      folder.write("jaw.toml", "scan.file = \"embedded\"\nmotion.arkit = \"jaw.csv\"\n")));
}

double greatest_difference_mm(const Inputs& a, const Inputs& b) {
  double most = 0;
  for (std::size_t k = 0; k < a.motion.motion.positions.size(); ++k)
    most = std::max(
        most,
        1e3 * (a.motion.motion.positions[k] - b.motion.motion.positions[k]).cwiseAbs().maxCoeff());
  return most;
}

TEST(Expressions, AWrongWeightIsMendedBeforeItMovesTheFace) {
  using namespace test;
  using testing::AllOf;
  using testing::Contains;
  using testing::Not;
  for (const auto& [wrong, said] :
       {std::pair{std::vector{1.0}, "jaw.csv:22, jawOpen at 0.333 s: by +0.79"},
        {std::vector{1.0, 1.0, 1.0}, "jaw.csv:22, jawOpen at 0.333 s: by +0.80"}}) {
    const Inputs in = with_wrong_jaw(wrong);
    EXPECT_THAT(in.notes, Contains(AllOf(is_warning("recording.wild_weights"),
                                         is_about("motion.arkit"), says(said))));
    EXPECT_THAT(in.notes, Not(Contains(has_id("recording.wild_samples"))));
    EXPECT_THAT(in.notes, Not(Contains(has_id("recording.jumps"))));
    EXPECT_LT(greatest_difference_mm(in, with_wrong_jaw({})), 1e-6);
  }
}

/// Mending the points that go far, and not the others, would give a face that nobody makes.
TEST(Expressions, PointsThatWeightsMoveAreNotMendedOneByOne) {
  using namespace test;
  // Up in two steps: no weight that is mended.
  const Inputs in = with_wrong_jaw({0.65, 1});
  EXPECT_THAT(in.notes, testing::Contains(testing::AllOf(is_warning("recording.jumps"),
                                                         says("jaw.csv:23, point "))));
  EXPECT_THAT(in.notes, testing::Not(testing::Contains(has_id("recording.wild_samples"))));
  const auto& motion = in.motion.motion;
  const int lip = motion.index_of("ibug68_57"), corner = motion.index_of("ibug68_48");
  const auto moved_m = [&](int point, std::size_t k) {
    return (motion.positions[k].row(point) - motion.positions[0].row(point)).norm();
  };
  for (const int point : {lip, corner})
    EXPECT_NEAR(moved_m(point, 21) / moved_m(point, 30), 1 / 0.3, 0.3) << point;
}

/// No cell of a table of weights holds the reading of a point.
TEST(Expressions, PointsThatShapesCarryTooFarAreNotCalledReadings) {
  motion::Motion motion;
  motion.names = {"ibug68_62"};
  motion.time_s = {0, 0.1};
  motion.positions = {Points::Zero(1, 3), Points::Constant(1, 3, 0.02)};
  motion.source = "weights.csv";
  motion.lines = {2, 3};
  const auto of_weights = far_points_warning(motion, Readings::of_weights);
  ASSERT_TRUE(of_weights);
  EXPECT_THAT(of_weights->text, testing::HasSubstr("correct the weights or the rig's shapes"));
  EXPECT_THAT(of_weights->text, testing::Not(testing::HasSubstr("readings")));
  EXPECT_THAT(far_points_warning(motion)->text, testing::HasSubstr("correct the readings"));
}

/// Both eyes look to the left by half; then the left one looks up.
class Looking : public testing::Test {
 protected:
  scene::Scene scene(const std::string& keys) const {
    folder_.write("look.csv",
                  "time_s,jawOpen,eyeLookOutLeft,eyeLookInRight,eyeLookUpLeft\n"
                  "5,0,0,0,0\n5.5,0.1,0.5,0.5,0\n6,0.1,0,0,1\n");
    return read_scene(folder_.write(
        "look.toml", "scan.file = \"embedded\"\nmotion.arkit = \"look.csv\"\n" + keys));
  }
  static constexpr double kHalf_deg = 0.5 * expression::kLookAside_deg;

 private:
  SceneFolder folder_;
};

TEST_F(Looking, CountsFromTheStartOfTheRun) {
  const auto yaw_deg = [&](const std::string& keys, double time_s) {
    return expression::degrees_of(read_inputs(scene(keys)).gaze.value().at(time_s))[2];
  };
  EXPECT_NEAR(yaw_deg("", 0.25), 0.5 * kHalf_deg, 1e-6);
  EXPECT_NEAR(yaw_deg("", 0.5), kHalf_deg, 1e-6);
  EXPECT_NEAR(yaw_deg("motion.time_scale = 2\n", 1), kHalf_deg, 1e-6);
  EXPECT_NEAR(yaw_deg("time.start_s = 0.5\n", motion::rest_lead_s), kHalf_deg, 1e-6)
      << "a run that begins there leads the face from rest first";
}

TEST_F(Looking, IsLedFromRestAsTheFaceIs) {
  const auto yaw_deg = [&](const std::string& keys, double time_s) {
    return expression::degrees_of(read_inputs(scene(keys)).gaze.value().at(time_s))[2];
  };
  EXPECT_NEAR(yaw_deg("time.start_s = 0.5\n", 0), 0, 1e-9);
  EXPECT_NEAR(yaw_deg("time.start_s = 0.5\n", 0.1), 0.05792 * kHalf_deg, 1e-6);
  const std::string slowly = "time.start_s = 0.5\nmotion.time_scale = 2\n";
  EXPECT_NEAR(yaw_deg(slowly, 0.2), 0.05792 * kHalf_deg, 1e-6);
  EXPECT_NEAR(yaw_deg(slowly, 1), kHalf_deg, 1e-6);
}

TEST_F(Looking, TurnsTheEyesOfBaseAndVariants) {
  FaceSession face(scene("drive.by = \"displacement\"\nmesh.element_size_mm = 10\n"
                         "mesh.layers = 1\ntime.frame_rate_hz = 5\n"),
                   {.certainty = Certainty::on_request});
  const FaceResult variant = face.variant("stiff", {{"tissue.young_kpa", 300}});
  for (const simulate::Performance* one :
       {&face.simulation().performance, &variant.performance()}) {
    ASSERT_EQ(one->gaze.size(), one->frame_time_s.size());
    EXPECT_NEAR(one->frame_time_s[2], 0.4, 1e-9);
    const auto degrees = expression::degrees_of(one->gaze[2]);
    EXPECT_NEAR(degrees[0], 0.8 * kHalf_deg, 1e-6) << "the right eye, to the left";
    EXPECT_NEAR(degrees[2], 0.8 * kHalf_deg, 1e-6);
  }
  EXPECT_THAT(face.notes(), testing::Not(testing::Contains(test::has_id("eyes.closed"))));
  ASSERT_TRUE(face.backing()) << "it was made for the notes";
  EXPECT_EQ(face.backing()->eyeballs.size(), 2u);
}

TEST(Expressions, AGazeAsideAloneTurnsTheEyesOfAFaceAtRest) {
  const SceneFolder folder;
  folder.write("gaze.csv", "time_s,eyeLookOutLeft,eyeLookInRight\n0,0,0\n0.1,0.5,0.5\n0.2,1,1\n");
  const Inputs in = read_inputs(read_scene(
      folder.write("gaze.toml", "scan.file = \"embedded\"\nmotion.arkit = \"gaze.csv\"\n")));
  const auto degrees = expression::degrees_of(in.gaze.value().at(0.2));
  for (const std::size_t yaw : {0, 2})
    EXPECT_NEAR(degrees[yaw], expression::kLookAside_deg, 1e-6) << "to the subject's left";
  for (const Points& at : in.motion.motion.positions)
    EXPECT_LT((at - in.motion.motion.positions[0]).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_THAT(in.notes, testing::Contains(testing::AllOf(
                            test::is_warning("recording.nothing_moves"),
                            test::says("nothing moves in the recording but the eyes"))));
}

TEST(Expressions, LidsFollowAGazeDownAlone) {
  const SceneFolder folder;
  folder.write("gaze.csv", "time_s,eyeLookDownLeft\n0,0\n0.1,0.5\n0.2,1\n");
  const Inputs in = read_inputs(read_scene(
      folder.write("gaze.toml", "scan.file = \"embedded\"\nmotion.arkit = \"gaze.csv\"\n")));
  const motion::Motion& m = in.motion.motion;
  const auto lid = m.index_of("ibug68_43");
  EXPECT_LT(m.positions.back()(lid, 1) - m.positions.front()(lid, 1), -2e-3);
  EXPECT_THAT(in.notes, testing::Not(testing::Contains(test::has_id("recording.nothing_moves"))));
}

/// Lids count from the sample that is rest, eyes from straight ahead.
TEST(Expressions, EyesThatLookDownAtRestAreTold) {
  const SceneFolder folder;
  const auto notes = [&](double at_start, const std::string& keys) {
    folder.write("gaze.csv", fmt::format("time_s,jawOpen,eyeLookDownLeft,eyeLookDownRight\n"
                                         "5,0,{0},{0}\n5.1,0,0,0\n5.3,0,0,0\n5.4,0.5,0,0\n",
                                         at_start));
    return read_inputs(read_scene(folder.write("gaze.toml",
                                               "scan.file = \"embedded\"\nmotion.arkit = "
                                               "\"gaze.csv\"\n" +
                                                   keys)))
        .notes;
  };
  const auto told = testing::Contains(
      testing::AllOf(test::is_note("gaze.not_ahead_at_rest"), test::says("look 7 degrees down")));
  EXPECT_THAT(notes(0.2, ""), told);
  EXPECT_THAT(notes(0.1, ""),
              testing::Not(testing::Contains(test::has_id("gaze.not_ahead_at_rest"))));
  EXPECT_THAT(notes(0.2, "motion.rest_s = [0.1, 0.3]\n"),
              testing::Not(testing::Contains(test::has_id("gaze.not_ahead_at_rest"))));
}

TEST(Expressions, WithoutAGazeTurnNoEyes) {
  EXPECT_FALSE(with_wrong_jaw({}).gaze);
}

}  // namespace
}  // namespace hyperex::session
