// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/degraded_source.hpp"

#include <gtest/gtest.h>

#include <opencv2/core.hpp>

namespace hyperex::test {
namespace {

/// Twelve frames of uniform grey at a constant distance.
class Plain : public capture::FrameSource {
 public:
  const capture::Intrinsics& intrinsics() const override { return camera_; }
  bool has_depth() const override { return true; }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return 12; }
  std::optional<capture::Frame> next() override {
    if (at_ == 12) return std::nullopt;
    capture::Frame frame;
    frame.index = at_++;
    frame.colour = cv::Mat(60, 90, CV_8UC3, cv::Scalar::all(200));
    frame.depth_m = cv::Mat(60, 90, CV_32F, cv::Scalar(0.5));
    return frame;
  }

 private:
  capture::Intrinsics camera_{50, 50, 44.5, 29.5, 90, 60};
  std::size_t at_ = 0;
};

std::vector<capture::Frame> frames_of(const Degradation& degradation) {
  std::vector<capture::Frame> frames;
  const auto source = degraded(std::make_unique<Plain>(), degradation);
  EXPECT_EQ(source->has_depth(), !degradation.without_depth);
  while (auto frame = source->next()) frames.push_back(std::move(*frame));
  EXPECT_EQ(frames.size(), 12u);
  return frames;
}

bool all_are(const cv::Mat& picture, double value) {
  double low, high;
  cv::minMaxLoc(picture.reshape(1), &low, &high);
  return low == value && high == value;
}

TEST(DegradedSource, WithoutAnythingGivesWhatItGets) {
  for (const auto& frame : frames_of({})) {
    EXPECT_TRUE(all_are(frame.colour, 200));
    EXPECT_TRUE(all_are(frame.depth_m, 0.5));
  }
}

TEST(DegradedSource, HolesAreAsManyAsStatedAndOthersInEachFrame) {
  const auto frames = frames_of({.depth_holes = 0.3});
  const auto readings = [](const cv::Mat& depth) { return cv::countNonZero(depth) / (60 * 90.0); };
  for (const auto& frame : frames) EXPECT_NEAR(readings(frame.depth_m), 0.7, 0.03);
  EXPECT_GT(cv::norm(frames[0].depth_m, frames[1].depth_m), 1);
  EXPECT_EQ(cv::norm(frames[1].depth_m, frames_of({.depth_holes = 0.3})[1].depth_m), 0);
  EXPECT_TRUE(frames_of({.without_depth = true})[0].depth_m.empty());
}

TEST(DegradedSource, DarkThenNoisy) {
  for (const auto& frame : frames_of({.brightness = 0.5, .noise_levels = 8})) {
    cv::Scalar mean, deviation;
    cv::meanStdDev(frame.colour, mean, deviation);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(mean[c], 100, 0.6);
      EXPECT_NEAR(deviation[c], 8, 0.4);
    }
  }
}

TEST(DegradedSource, BlackFramesKeepTheirDepth) {
  const Degradation black{.black = {4, 3}};
  const auto frames = frames_of(black);
  for (std::size_t k = 0; k < 12; ++k) {
    EXPECT_EQ(black.spoils(k), k >= 4 && k < 7) << k;
    EXPECT_TRUE(all_are(frames[k].colour, black.spoils(k) ? 0 : 200)) << k;
    EXPECT_TRUE(all_are(frames[k].depth_m, 0.5)) << k;
  }
}

TEST(DegradedSource, AFaceSlidesOutStaysOutAndComesBack) {
  const auto frames = frames_of({.away = {2, 8}});
  const auto left = [](const capture::Frame& frame) {
    return cv::countNonZero(frame.depth_m) / 60;
  };
  EXPECT_EQ(left(frames[1]), 90);
  EXPECT_LT(left(frames[2]), 90);
  EXPECT_LT(left(frames[3]), left(frames[2]));
  for (const std::size_t out : {5u, 6u}) {
    EXPECT_EQ(left(frames[out]), 0) << out;
    EXPECT_TRUE(all_are(frames[out].colour, 110)) << out;
  }
  EXPECT_EQ(left(frames[9]), left(frames[2]));
  EXPECT_EQ(frames[2].colour.at<cv::Vec3b>(30, 0)[0], 110);  // to the right: the wall on the left
  EXPECT_EQ(frames[2].colour.at<cv::Vec3b>(30, 89)[0], 200);
  EXPECT_EQ(left(frames[10]), 90);
}

}  // namespace
}  // namespace hyperex::test
