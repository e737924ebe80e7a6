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

TEST(RunCost, GrowsWithWhatARunWrites) {
  scene::Scene scene = embedded();
  const Inputs inputs = read_inputs(scene);
  const auto cost = [&] { return *expected_cost(scene, inputs, Extent::full); };
  const RunCost whole = cost();
  EXPECT_EQ(whole.frames, 80);
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
  scene.model.strain = simulate::Strain::finite;
  EXPECT_EQ(cost().seconds, 0);
  EXPECT_THAT(sentence_of(cost()), testing::HasSubstr("not known in advance"));
}

TEST(RunCost, OfACamerasRecordingIsNotKnownBeforeItIsRead) {
  scene::Scene scene = embedded();
  Inputs inputs = read_inputs(scene);
  scene.motion.recording = "talk";
  inputs.lasts_s = 0;
  EXPECT_FALSE(expected_cost(scene, inputs, Extent::quick));
  EXPECT_TRUE(expected_cost(scene, inputs, Extent::full));
  inputs.lasts_s = 4;  // by the number of its frames
  EXPECT_EQ(expected_cost(scene, inputs, Extent::quick)->frames, 120);
  scene.time.end_s = 1;
  EXPECT_EQ(expected_cost(scene, inputs, Extent::quick)->frames, 30);
}

/// A quick estimate does not search for landmarks and does not align anything.
TEST(RunCost, IsKnownOfAScanWithoutLandmarks) {
  Inputs inputs;
  inputs.scan = read_inputs(embedded()).scan;
  inputs.lasts_s = 3;
  const auto cost = expected_cost(embedded(), inputs, Extent::quick);
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->frames, 90);
}

TEST(RunCost, SaysWhatOfTheRecordingIsRun) {
  scene::Scene scene = embedded();
  const auto sentence = [&] {
    return sentence_of(*expected_cost(scene, read_inputs(scene), Extent::quick));
  };
  EXPECT_THAT(sentence(), testing::HasSubstr("from 0 s to 2.667 s of the recording"));
  scene.motion.start_s = 1;
  scene.time.end_s = 1.5;  // half a second of it leads from rest to where the run begins
  EXPECT_THAT(sentence(), testing::HasSubstr("from 1 s to 2 s of the recording"));
  scene.time.end_s = 1;
  scene.motion.time_scale = 0.5;
  EXPECT_THAT(sentence(), testing::HasSubstr("from 1 s to 2.5 s of the recording"));
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
  EXPECT_THAT(
      test::refusal([&] { check_disk(scene, cost); }),
      testing::AllOf(testing::HasSubstr("output.most_gb"), testing::HasSubstr("3.8 or more"),
                     testing::HasSubstr("3.00 GB for ParaView")));
  scene.motion.arkit = "weights.csv";
  const Note doubt = make_warning("recording.time_unit_doubtful", "milliseconds?", "motion.arkit");
  EXPECT_THAT(test::refusal([&] { check_disk(scene, cost, {doubt}); }),
              testing::HasSubstr("motion.arkit = \"weights.csv\": expected times in seconds "
                                 "(milliseconds?); where they are, output.most_gb = 3.8 or more"));
  scene.output.most_gb = 3.8;
  EXPECT_NO_THROW(check_disk(scene, cost));
}

}  // namespace
}  // namespace hyperex::session
