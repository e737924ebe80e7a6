// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/session/kept.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstring>
#include <fstream>

#include "support/test_file.hpp"

namespace hyperex::session {
using namespace scene;
namespace {
namespace fs = std::filesystem;

RecordedFace some_recording() {
  RecordedFace recorded;
  motion::Motion& m = recorded.motion;
  m.names = {"pogonion", "ibug68_48"};
  m.time_s = {0, 1.0 / 30, 0.1};
  for (int k = 0; k < 3; ++k) {
    m.positions.push_back(Points::Random(2, 3) / 3);
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translate(Vec3(0.1, k, -1e-300));
    pose.rotate(Eigen::AngleAxisd(0.3 + k, Vec3(1, 2, 3).normalized()));
    m.head_pose.push_back(pose);
  }
  m.positions[1].row(0).setConstant(std::nan(""));
  m.triangles.resize(1, 3);
  m.triangles << 0, 1, 0;
  recorded.notes = {make_note("recording.tracked", "motion: a face tracked in 2 of 3 frames"),
                    make_note("recording.source", "\u00e4", "motion.recording")};
  return recorded;
}

bool same_bits(const Points& a, const Points& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), sizeof(double) * std::size_t(a.size())) == 0;
}

TEST(Kept, ARecordingComesBackBitForBit) {
  const RecordedFace recorded = some_recording();
  const auto back = recorded_from(bytes_of(recorded));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->notes, recorded.notes);
  EXPECT_EQ(back->motion.names, recorded.motion.names);
  EXPECT_EQ(back->motion.time_s, recorded.motion.time_s);
  EXPECT_EQ(back->motion.triangles, recorded.motion.triangles);
  ASSERT_EQ(back->motion.positions.size(), 3u);
  ASSERT_EQ(back->motion.head_pose.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_TRUE(same_bits(back->motion.positions[k], recorded.motion.positions[k]));
    EXPECT_EQ(back->motion.head_pose[k].matrix(), recorded.motion.head_pose[k].matrix());
  }
}

TEST(Kept, LandmarksComeBackBitForBit) {
  const FoundLandmarks found{
      {{"pogonion", {0.1, 1.0 / 3, -1e-9}}, {"ibug68_8", {1, 2, 3}}}, 14, 1.0 / 7, true};
  const auto back = landmarks_from(bytes_of(found));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->landmarks, found.landmarks);
  EXPECT_EQ(back->views, 14);
  EXPECT_EQ(back->spread_m, 1.0 / 7);
  EXPECT_TRUE(back->without_colours);
}

TEST(Kept, CompletedLandmarksComeBackBitForBit) {
  const anatomy::CompletedLandmarks completed{
      {{"pogonion", {0.1, 1.0 / 3, -1e-9}}, {"ibug68_8", {1, 2, 3}}}, {"ibug68_8"}};
  const auto back = completed_from(bytes_of(completed));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->landmarks, completed.landmarks);
  EXPECT_EQ(back->placed, completed.placed);
  EXPECT_FALSE(completed_from(bytes_of(FoundLandmarks{})));
}

TEST(Kept, BytesOfSomethingElseAreNothing) {
  const std::string recording = bytes_of(some_recording());
  EXPECT_FALSE(landmarks_from(recording));
  EXPECT_FALSE(recorded_from(bytes_of(FoundLandmarks{})));
  for (const std::string& bytes : {std::string(), std::string("{}"), recording.substr(1),
                                   recording.substr(0, recording.size() - 3)})
    EXPECT_FALSE(recorded_from(bytes));
}

/// A scene with a recording in one file and a folder for kept results.
class KeptRecording : public testing::Test {
 protected:
  void SetUp() override {
    fs::create_directories(folder / "recording" / "depth");
    write("recording/colour.txt", "one");
    write("recording/depth/1.png", "two");
    scene.motion.recording = folder / "recording";
    scene.kept = KeptResults(folder / "kept");
  }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
  }
  /// Whether recorded_face() tracks the recording.
  bool tracks() {
    bool tracked = false;
    const RecordedFace recorded = recorded_face(scene, [&] {
      tracked = true;
      return some_recording();
    });
    EXPECT_EQ(recorded.motion.names.size(), 2u);
    return tracked;
  }
  const TestFolder folder;
  Scene scene;
};

TEST_F(KeptRecording, IsTrackedOnceUntilAnythingThatMattersChanges) {
  EXPECT_TRUE(tracks());
  EXPECT_FALSE(tracks());
  write("recording/depth/1.png", "Two");
  EXPECT_TRUE(tracks());
  EXPECT_FALSE(tracks());
  write("recording/depth/2.png", "");
  EXPECT_TRUE(tracks());
  scene.motion.mirrored = true;
  EXPECT_TRUE(tracks());
  scene.motion.rest_s = {0.5};
  EXPECT_TRUE(tracks());
  scene.motion.rest_s = {0.5, 1};
  EXPECT_TRUE(tracks());
  scene.region.measured = scene.region.measured == simulate::Measured::none
                              ? simulate::Measured::all
                              : simulate::Measured::none;
  EXPECT_TRUE(tracks());
  write("candide.wfm", "model");
  scene.motion.candide = folder / "candide.wfm";
  EXPECT_TRUE(tracks());
  EXPECT_FALSE(tracks());
  write("candide.wfm", "other");
  EXPECT_TRUE(tracks());
  scene.tissue.preset = "any";  // of no matter
  EXPECT_FALSE(tracks());
}

TEST_F(KeptRecording, IsTrackedEachTimeWhereNothingIsKept) {
  scene.kept = {};
  EXPECT_TRUE(tracks());
  EXPECT_TRUE(tracks());
}

TEST_F(KeptRecording, OfADeviceIsNeverKept) {
  scene.motion.recording = "/dev/null";
  EXPECT_TRUE(tracks());
  EXPECT_TRUE(tracks());
}

}  // namespace
}  // namespace hyperex::session
