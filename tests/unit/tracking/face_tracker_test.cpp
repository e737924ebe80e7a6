// SPDX-License-Identifier: GPL-3.0-or-later
// The tracker on pictures and depth of the embedded face, as from a camera with a very long focal
// length.
#include "hyperex/tracking/fit/face_tracker.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "support/face_recording.hpp"

namespace hyperex::tracking {
namespace {

using test::face_frame;

double turn_between_deg(const TrackedFrame& a, const TrackedFrame& b) {
  const Eigen::AngleAxisd turn(a.camera_from_head.linear().transpose() *
                               b.camera_from_head.linear());
  return turn.angle() * turn.axis().y() * 180 / std::numbers::pi;
}

TrackerOptions options_for(int neutral_frames) {
  TrackerOptions options;
  options.neutral_frames = neutral_frames;
  return options;
}

TEST(FaceTracker, HoldsTheFirstFramesBackThenGivesFrameByFrame) {
  FaceTracker tracker(expression::canonical_model(), test::kFaceCamera, options_for(3));
  capture::Frame broken = face_frame(0, 0);
  broken.valid = false;
  broken.fault = "torn";
  std::vector<TrackedFrame> given = tracker.feed(broken);
  EXPECT_FALSE(tracker.neutral());
  for (std::size_t k = 1; k < 4; ++k)
    for (auto& frame : tracker.feed(face_frame(k, 0))) {
      EXPECT_EQ(k, 3u);  // not before the third face
      given.push_back(std::move(frame));
    }
  ASSERT_EQ(given.size(), 4u);
  EXPECT_FALSE(given[0].valid);
  EXPECT_EQ(given[0].fault, "torn");
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(given[k].index, k);
  EXPECT_TRUE(given[3].valid) << given[3].fault;
  ASSERT_TRUE(tracker.neutral());
  EXPECT_TRUE(tracker.neutral()->metric);
  EXPECT_NEAR(tracker.neutral()->scale, 1, 0.06);  // the embedded face is the canonical one
  EXPECT_NEAR(given[3].camera_from_head.translation().z(), test::kFaceDistance_m, 0.05);
  EXPECT_EQ(tracker.feed(face_frame(4, 0.02)).size(), 1u);
  EXPECT_TRUE(tracker.finish().empty());
}

TEST(FaceTracker, ShortRecordingsAreGivenAtTheEnd) {
  FaceTracker tracker(expression::canonical_model(), test::kFaceCamera, options_for(30));
  EXPECT_TRUE(tracker.feed(face_frame(0, 0)).empty());
  EXPECT_TRUE(tracker.feed(face_frame(1, 0)).empty());
  const auto given = tracker.finish();
  ASSERT_EQ(given.size(), 2u);
  EXPECT_TRUE(given[0].valid && given[1].valid);
}

TEST(FaceTracker, FollowsATurnThroughBlackAndBrokenFrames) {
  FaceTracker tracker(expression::canonical_model(), test::kFaceCamera, options_for(2));
  std::vector<TrackedFrame> given;
  const auto feed = [&](const capture::Frame& frame) {
    for (auto& one : tracker.feed(frame)) given.push_back(std::move(one));
  };
  const auto yaw = [](std::size_t k) { return k < 2 ? 0.0 : 0.02 * double(k - 1); };
  for (std::size_t k = 0; k < 14; ++k) {
    capture::Frame frame = face_frame(k, yaw(k));
    if (k == 5) frame.valid = false;
    if (k == 8 || k == 9) frame.colour.setTo(0);
    feed(frame);
  }
  ASSERT_EQ(given.size(), 14u);
  for (std::size_t k = 0; k < 14; ++k) {
    const bool sound = k != 5 && k != 8 && k != 9;
    EXPECT_EQ(given[k].valid, sound) << k << ": " << given[k].fault;
    if (!given[k].valid) {
      EXPECT_FALSE(given[k].fault.empty()) << k;
      continue;
    }
    EXPECT_NEAR(turn_between_deg(given[0], given[k]), yaw(k) * 180 / std::numbers::pi, 1) << k;
    EXPECT_GT(given[k].report.depth_share, 0.5) << k;
  }
}

TEST(FaceTracker, AFaceThatComesBackElsewhereIsFoundAgain) {
  FaceTracker tracker(expression::canonical_model(), test::kFaceCamera, options_for(2));
  std::vector<TrackedFrame> given;
  const auto feed = [&](capture::Frame frame, int right_px) {
    cv::Mat colour(frame.colour.size(), CV_8UC3, cv::Scalar::all(115)),
        depth = cv::Mat::zeros(frame.depth_m.size(), CV_32F);
    const int width = test::kFaceSize_px - right_px;
    if (width > 0) {
      const cv::Rect from(0, 0, width, test::kFaceSize_px),
          to(right_px, 0, width, test::kFaceSize_px);
      frame.colour(from).copyTo(colour(to));
      frame.depth_m(from).copyTo(depth(to));
    }
    frame.colour = colour;
    frame.depth_m = depth;
    for (auto& one : tracker.feed(frame)) given.push_back(std::move(one));
  };
  const int at_px[] = {0, 0, 0, 150, test::kFaceSize_px, test::kFaceSize_px, 40, 40, 40};
  for (std::size_t k = 0; k < std::size(at_px); ++k) feed(face_frame(k, 0), at_px[k]);
  ASSERT_EQ(given.size(), std::size(at_px));
  for (const std::size_t k : {3u, 4u, 5u}) EXPECT_FALSE(given[k].valid) << k;  // cut off, gone
  for (const std::size_t k : {0u, 1u, 2u, 6u, 7u, 8u})
    EXPECT_TRUE(given[k].valid) << k << ": " << given[k].fault;
  const Vec3 shift =
      given[8].camera_from_head.translation() - given[0].camera_from_head.translation();
  EXPECT_NEAR(shift.x(), 40 / test::kFacePxPerM, 2e-3);
  EXPECT_NEAR(shift.y(), 0, 2e-3);
}

TEST(FaceTracker, WithoutDepthTheSizeIsWhatTheEyesAreSaidToBeApart) {
  TrackerOptions options = options_for(2);
  options.use_depth = false;
  options.neutral.eye_distance_m = 0.08;
  FaceTracker tracker(expression::canonical_model(), test::kFaceCamera, options);
  tracker.feed(face_frame(0, 0));
  const auto given = tracker.feed(face_frame(1, 0));
  ASSERT_EQ(given.size(), 2u);
  ASSERT_TRUE(given[1].valid) << given[1].fault;
  EXPECT_FALSE(tracker.neutral()->metric);
  const auto& corners = expression::canonical_model().landmarks;
  EXPECT_NEAR((expression::landmark_at(corners.at("exocanthion_L"), given[1].vertices_m) -
               expression::landmark_at(corners.at("exocanthion_R"), given[1].vertices_m))
                  .norm(),
              0.08, 0.002);
  EXPECT_EQ(given[1].report.depth_share, 0);
}

}  // namespace
}  // namespace hyperex::tracking
