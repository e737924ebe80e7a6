// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/run_cost.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hyperex/session/prepared_face.hpp"
#include "support/refusal.hpp"

namespace hyperex::session {
namespace {

scene::Scene embedded() {
  scene::Scene scene;
  scene.scan.source.embedded = scene.motion.source.embedded = true;
  scene.mesh.element_size_m = 0.006;
  return scene;
}

TEST(RunCost, OfTheScanAloneIsThatOfItsMeshRoughly) {
  const scene::Scene scene = embedded();
  Inputs inputs = read_inputs(scene);
  const auto before = expected_cost(scene, inputs, Extent::quick);
  const PreparedFace face = prepare_face(scene, inputs, [] {});
  const auto after = expected_cost(scene, inputs, Extent::full, &face.mesh->volume);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(before->frames, after->frames);
  EXPECT_NEAR(before->frames_bytes / after->frames_bytes, 1, 0.3);
  EXPECT_NEAR(before->memory_bytes / after->memory_bytes, 1, 0.3);
}

/// Nodes and memory as measured with runs (output.vtu where the scene says so), without meshing.
TEST(RunCost, IsCloseToWhatWasMeasured) {
  struct Measured {
    double element_mm, nodes, memory_gb;
  };
  const auto compare = [](const std::string& name, scene::Scene scene,
                          const std::vector<Measured>& measured) {
    Inputs inputs = read_inputs(scene);
    for (const Measured& run : measured) {
      scene.mesh.element_size_m = 1e-3 * run.element_mm;
      const auto cost = expected_cost(scene, inputs, Extent::full);
      ASSERT_TRUE(cost);
      EXPECT_NEAR(cost->nodes / run.nodes, 1, 0.05) << name << ", " << run.element_mm << " mm";
      EXPECT_NEAR(cost->memory_bytes / (1e9 * run.memory_gb), 1, 0.15)
          << name << ", " << run.element_mm << " mm";
    }
  };
  compare("embedded", embedded(), {{5, 2169, 0.283}, {3.3, 5022, 0.621}, {2.2, 11175, 1.359}});
  const std::filesystem::path shared = std::filesystem::path(HYPEREX_SHARED_DIR) / "data";
  if (!std::filesystem::exists(shared)) GTEST_SKIP() << "two faces of three are not here";
  scene::Scene rig = embedded();
  rig.scan.source = {.file = shared / "ict/subject_A_neutral_scan.ply"};
  rig.scan.landmarks = shared / "ict/subject_A_landmarks.json";
  compare("subject A", rig, {{5, 2781, 0.433}, {3.3, 6396, 0.820}, {2.2, 14412, 1.998}});
  compare("real smile", scene::read_scene(shared / "real/spacetime/smile_7.toml", {}),
          {{5, 2658, 0.343}, {3.3, 6075, 0.753}, {2.2, 13566, 1.689}});
}

TEST(RunCost, GrowsWithWhatARunWrites) {
  scene::Scene scene = embedded();
  const Inputs inputs = read_inputs(scene);
  const auto cost = [&] { return *expected_cost(scene, inputs, Extent::full); };
  const RunCost whole = cost();
  EXPECT_EQ(whole.frames, 81);
  EXPECT_EQ(whole.variants_seconds, 0);
  scene.output.vtu_strain = false;
  EXPECT_LT(cost().frames_bytes, 0.6 * whole.frames_bytes);
  scene.output.vtu_every = 3;
  EXPECT_NEAR(cost().frames_bytes, 0.4 * whole.frames_bytes / 3, 0.04 * whole.frames_bytes);
  scene.output.vtu = false;
  EXPECT_EQ(cost().frames_bytes, 0);
  EXPECT_GT(cost().disk_bytes, 1e6);
  scene.time.frame_rate_hz = 60;
  EXPECT_GT(cost().memory_bytes, whole.memory_bytes);
  scene.variants.resize(2);
  EXPECT_GT(cost().variants_seconds, 0);
  EXPECT_THAT(sentence_of(cost()), testing::HasSubstr("without its variants"));
  const RunCost plain = cost();
  scene.output.error_budget = true;
  EXPECT_GT(cost().seconds, 2 * plain.seconds);
  EXPECT_GT(cost().memory_bytes, 1.5 * plain.memory_bytes - plain.motion_bytes);
  EXPECT_THAT(sentence_of(cost()), testing::HasSubstr("of them for the error budget"));
  scene.model.strain = simulate::Strain::finite;
  EXPECT_EQ(cost().seconds, 0);
  EXPECT_THAT(sentence_of(cost()), testing::HasSubstr("not known in advance"));
}

/// The embedded face without a motion, which is as long as a test says.
Inputs face_alone() {
  Inputs inputs = read_inputs(embedded());
  inputs.motion.motion = {};
  return inputs;
}

/// Times of the processors of runs on the embedded face in elements of 3.3 mm, less the fifth that
/// other programs took: a range of motion, a smile, a mouth opening that is held.
TEST(RunCost, TimesAreWithinAFactorOfTwoOfMeasuredOnes) {
  using simulate::DriveBy;
  struct Measured {
    const char* what;
    double lasts_s, end_s, rate_hz, step_s;
    DriveBy by;
    bool pages, direct;
    double processor_s;
  };
  Inputs inputs = face_alone();
  scene::Scene scene = embedded();
  scene.mesh.element_size_m = 0.0033;
  scene.output.vtu = false;
  scene.origins["drive.by"] = {};
  for (const Measured& run :
       {Measured{"10 s", 134.4, 10, 30, 0.002, DriveBy::muscles, false, false, 16.6},
        {"40 s", 134.4, 40, 30, 0.002, DriveBy::muscles, false, false, 36.8},
        {"40 s in longer steps", 134.4, 40, 30, 0.006, DriveBy::muscles, false, false, 22.5},
        {"134 s", 134.4, 0, 30, 0.002, DriveBy::muscles, false, false, 88},
        {"134 s with its pages", 134.4, 0, 30, 0.002, DriveBy::muscles, true, false, 143},
        {"by displacement", 134.4, 40, 30, 0.002, DriveBy::displacement, false, false, 8.5},
        {"by reactions", 134.4, 10, 30, 0.002, DriveBy::reactions, false, false, 5.4},
        {"a smile", 2, 0, 30, 0.002, DriveBy::muscles, true, false, 5.4},
        {"held", 2.67, 60, 1, 0.002, DriveBy::muscles, true, false, 6.4},
        {"held, more frames", 2.67, 60, 30, 0.002, DriveBy::displacement, true, false, 13.8},
        {"the full model", 2.67, 30, 1, 0.002, DriveBy::muscles, true, true, 92}}) {
    inputs.lasts_s = run.lasts_s;
    scene.time.step_s = run.step_s;
    scene.time.end_s = run.end_s;
    scene.time.frame_rate_hz = run.rate_hz;
    scene.drive.by = run.by;
    scene.output.glb = scene.output.report = run.pages;
    scene.solver.method =
        run.direct ? simulate::SolverMethod::direct : simulate::SolverMethod::reduced;
    const double ratio = expected_cost(scene, inputs, Extent::full)->seconds / run.processor_s;
    EXPECT_GT(ratio, 0.5) << run.what;
    EXPECT_LT(ratio, 2) << run.what;
  }
}

/// The embedded face with a recording at 30 Hz whose points move by up to 10 mm.
Inputs noisy(int points, int samples, double jitter_m) {
  Inputs inputs = face_alone();
  motion::Motion& motion = inputs.motion.motion;
  for (int p = 0; p < points; ++p) {
    motion.names.push_back("point_" + std::to_string(p));
    inputs.driven.push_back(motion.names.back());
  }
  for (int k = 0; k < samples; ++k) {
    motion.time_s.push_back(k / 30.0);
    motion.positions.push_back(
        Points::Constant(points, 3, k == samples / 2 ? 0.010 / std::sqrt(3.0) : 0));
  }
  inputs.jitter_m = jitter_m;
  return inputs;
}

/// Times of the processors of runs without pages in a mesh of 5973 nodes.
TEST(RunCost, TimesOfNoisyRecordingsAreWithinAFactorOfTwoOfMeasuredOnes) {
  using simulate::DriveBy;
  struct Measured {
    const char* what;
    int points, samples;
    double jitter_mm;
    DriveBy by;
    std::size_t variants;
    double processor_s;
  };
  scene::Scene scene = embedded();
  scene.mesh.element_size_m = 0.003;
  scene.output.vtu = scene.output.glb = scene.output.report = false;
  scene.origins["drive.by"] = {};
  for (const Measured& run :
       {Measured{"7 points", 7, 94, 0.2, DriveBy::muscles, 0, 6.9},
        {"34 points", 34, 94, 0.2, DriveBy::muscles, 0, 27.3},
        {"34 points and four variants", 34, 94, 0.2, DriveBy::muscles, 4, 116},
        {"34 points with less noise", 34, 94, 0.03, DriveBy::muscles, 0, 7.7},
        {"34 points for three times as long", 34, 282, 0.22, DriveBy::muscles, 0, 33.6},
        {"34 points by displacement", 34, 94, 0.2, DriveBy::displacement, 0, 3.3}}) {
    scene.drive.by = run.by;
    scene.variants.resize(run.variants);
    const Inputs inputs = noisy(run.points, run.samples, 1e-3 * run.jitter_mm);
    const double ratio = expected_cost(scene, inputs, Extent::full)->seconds / run.processor_s;
    EXPECT_GT(ratio, 0.5) << run.what;
    EXPECT_LT(ratio, 2) << run.what;
  }
}

TEST(RunCost, OfContactIsWhatItTakesAtMost) {
  scene::Scene scene = embedded();
  const Inputs inputs = read_inputs(scene);
  const auto cost = [&] { return *expected_cost(scene, inputs, Extent::full); };
  const RunCost without = cost();
  EXPECT_EQ(without.contact_seconds, 0);
  scene.contact.lips = true;
  EXPECT_EQ(cost().seconds, without.seconds);
  EXPECT_GT(cost().contact_seconds, 0);
  EXPECT_THAT(sentence_of(cost()),
              testing::HasSubstr("on two idle processors; contact adds up to"));
}

TEST(RunCost, ALongTakeIsKeptWithinTheBoundByFewerFrames) {
  scene::Scene scene = embedded();
  scene.mesh.element_size_m = 0.0033;
  Inputs inputs = face_alone();
  const auto cost = [&] { return *expected_cost(scene, inputs, Extent::full); };
  inputs.lasts_s = 10;
  EXPECT_EQ(vtu_every_within_bound(scene, cost()), 1);
  inputs.lasts_s = 134.4;
  EXPECT_GT(cost().disk_bytes, 3e9);
  const int every = vtu_every_within_bound(scene, cost());
  scene.output.vtu_every = every - 1;
  EXPECT_GT(1.2 * cost().disk_bytes, 2e9);
  scene.output.vtu_every = every;
  EXPECT_LE(1.2 * cost().disk_bytes, 2.01e9);
  EXPECT_NO_THROW(check_cost(scene, cost()));
  scene.output.vtu = false;
  scene.output.most_gb = 0.01;
  EXPECT_EQ(vtu_every_within_bound(scene, cost()), 1) << "no frames to leave out";
}

TEST(RunCost, OfACamerasRecordingIsNotKnownBeforeItIsRead) {
  scene::Scene scene = embedded();
  Inputs inputs = read_inputs(scene);
  scene.motion.recording = "talk";
  inputs.lasts_s = 0;
  EXPECT_FALSE(expected_cost(scene, inputs, Extent::quick));
  EXPECT_TRUE(expected_cost(scene, inputs, Extent::full));
  inputs.lasts_s = 4;  // by the number of its frames
  EXPECT_EQ(expected_cost(scene, inputs, Extent::quick)->frames, 121);
  scene.time.end_s = 1;
  EXPECT_EQ(expected_cost(scene, inputs, Extent::quick)->frames, 31);
}

/// A quick estimate does not search for landmarks and does not align anything.
TEST(RunCost, IsKnownOfAScanWithoutLandmarks) {
  Inputs inputs;
  inputs.scan = read_inputs(embedded()).scan;
  inputs.lasts_s = 3;
  const auto cost = expected_cost(embedded(), inputs, Extent::quick);
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->frames, 91);
}

TEST(RunCost, SaysWhatOfTheRecordingIsRun) {
  scene::Scene scene = embedded();
  const auto sentence = [&] {
    return sentence_of(*expected_cost(scene, read_inputs(scene), Extent::quick));
  };
  // 81 frames at 30 Hz, the last at the end.
  EXPECT_THAT(sentence(), testing::HasSubstr("from 0 s to 2.667 s of the recording; about"));
  scene.motion.start_s = 1;
  scene.time.end_s = 1.5;  // half a second of it leads from rest to where the run begins
  EXPECT_THAT(sentence(), testing::HasSubstr("from 1 s to 2 s of the recording, led in from rest "
                                             "over the 0.5 s before: frame 0 is at 0.5 s; about"));
  scene.time.end_s = 1;
  scene.motion.time_scale = 0.5;
  EXPECT_THAT(sentence(), testing::HasSubstr("from 1 s to 2.5 s of the recording"));
}

TEST(RunCost, IsAGuessWithoutLandmarks) {
  const scene::Scene scene = embedded();
  Inputs inputs = read_inputs(scene);
  const auto sentence = [&] { return sentence_of(*expected_cost(scene, inputs, Extent::quick)); };
  EXPECT_THAT(sentence(), testing::Not(testing::HasSubstr("a guess")));
  inputs.landmarks.clear();
  EXPECT_THAT(sentence(), testing::HasSubstr("of memory (a guess without landmarks"));
}

/// Measured on a scan from a clinic: five faces of 135 frames, no frames for ParaView, 166 MB.
TEST(RunCost, OfAFineScanIsThatOfItsVertices) {
  scene::Scene scene = embedded();
  scene.output.vtu = false;
  scene.variants.resize(4);
  Inputs inputs;
  inputs.scan.mesh.points = Points::Zero(36326, 3);
  inputs.scan.mesh.triangles = Triangles::Zero(1, 3);
  inputs.lasts_s = 4.5;
  const auto cost = expected_cost(scene, inputs, Extent::quick);
  ASSERT_TRUE(cost);
  EXPECT_NEAR(cost->disk_bytes, 166e6, 50e6);
}

TEST(RunCost, AboveTheBoundIsRefusedByTheKeyThatRaisesIt) {
  scene::Scene scene = embedded();
  RunCost cost;
  cost.disk_bytes = 3.1e9;
  cost.frames_bytes = 3e9;
  EXPECT_THAT(test::refusal([&] { check_cost(scene, cost); }),
              testing::AllOf(testing::HasSubstr("output.most_gb"),
                             testing::HasSubstr("expected 3.8 or more, which leaves 20 % to spare, "
                                                "as the run would write about 3.10 GB"),
                             testing::HasSubstr("3.00 GB for ParaView")));
  scene.motion.arkit = "weights.csv";
  const Note doubt = make_warning("recording.time_unit_doubtful", "milliseconds?", "motion.arkit");
  EXPECT_THAT(test::refusal([&] { check_cost(scene, cost, {doubt}); }),
              testing::EndsWith("motion.arkit = \"weights.csv\": expected times in seconds "
                                "(milliseconds?)"))
      << "a bound to raise would mislead";
  scene.output.most_gb = 3.8;
  EXPECT_NO_THROW(check_cost(scene, cost));
}

TEST(RunCost, OfMemoryIsBoundedToo) {
  scene::Scene scene = embedded();
  scene.mesh.element_size_m = 0.0005;
  scene.output.vtu = false;
  const Inputs inputs = read_inputs(scene);
  EXPECT_THAT(
      test::refusal([&] { checked_cost(scene, inputs, Extent::full); }),
      testing::ContainsRegex(
          "output.most_memory_gb = 8.0: expected [0-9.]+ or more, which "
          "leaves 20 % to spare, as the run would take about [0-9]+ GB of memory \\(for a mesh of "
          "[0-9]+ nodes; a larger mesh.element_size_mm needs fewer"));
  scene.output.most_memory_gb = 100;
  EXPECT_NO_THROW(checked_cost(scene, inputs, Extent::full));
  scene.mesh.element_size_m = 0.006;
  scene.output.most_memory_gb = 1;
  scene.time.frame_rate_hz = 5000;
  EXPECT_THAT(test::refusal([&] { checked_cost(scene, inputs, Extent::full); }),
              testing::HasSubstr("time.start_s and time.end_s shorten it"));
}

}  // namespace
}  // namespace hyperex::session
