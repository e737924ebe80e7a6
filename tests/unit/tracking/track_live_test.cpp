// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tracking/fit/track_live.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "face_pictures.hpp"
#include "hyperex/capture/buffered.hpp"
#include "hyperex/core/error.hpp"

namespace hyperex::tracking {
namespace {
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

/// A camera at 50 Hz in front of a still face.
class Camera : public capture::FrameSource {
 public:
  Camera(cv::Mat picture, std::size_t frames) : picture_(std::move(picture)), frames_(frames) {}
  const capture::Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return false; }
  bool live() const override { return true; }
  std::optional<std::size_t> frame_count() const override { return std::nullopt; }
  std::optional<capture::Frame> next() override {
    if (next_ == 0) start_ = Clock::now();
    if (next_ == frames_) return std::nullopt;
    std::this_thread::sleep_until(start_ + next_ * 20ms);
    capture::Frame frame;
    frame.index = next_++;
    frame.time_s = 0.02 * double(frame.index);
    frame.colour = picture_.clone();
    return frame;
  }

 private:
  cv::Mat picture_;
  std::size_t frames_, next_ = 0;
  Clock::time_point start_;
  capture::Intrinsics intrinsics_{500, 500, 159.5, 159.5, 320, 320};
};

capture::LatestFrame camera(std::size_t frames) {
  static const cv::Mat face = face_picture(320, 0.3).bgr;
  return capture::LatestFrame(std::make_unique<Camera>(face, frames));
}

TrackerOptions quick() {
  TrackerOptions options;
  options.neutral_frames = 4;
  return options;
}

/// Checks that frame numbers rise, and that the gaps between them up to the last are the dropped
/// frames.
void expect_order(const Tracking& tracking, std::size_t dropped) {
  std::size_t gaps = 0, expected = 0;
  for (const TrackedFrame& frame : tracking.frames) {
    ASSERT_GE(frame.index, expected);
    gaps += frame.index - expected;
    expected = frame.index + 1;
    EXPECT_NEAR(frame.time_s, 0.02 * double(frame.index), 1e-9);
  }
  EXPECT_LE(gaps, dropped);
}

TEST(TrackLive, ASlowConsumerDoesNotFallBehind) {
  constexpr std::size_t frames = 200;  // 4 s
  constexpr double work_s = 0.1;       // five periods
  capture::LatestFrame source = camera(frames);
  std::size_t visited = 0;
  const auto slow = [&](const TrackedFrame&, const cv::Mat& bgr) {
    EXPECT_FALSE(bgr.empty());
    ++visited;
    std::this_thread::sleep_for(std::chrono::duration<double>(work_s));
  };
  const LiveTracking live = track_live(source, expression::canonical_model(), quick(), {}, slow);
  const LiveStatus& status = live.status;
  EXPECT_EQ(visited, status.frames);
  EXPECT_EQ(live.tracking.frames.size(), status.frames);
  EXPECT_EQ(status.frames + status.dropped, frames);
  EXPECT_EQ(live.tracking.frames.back().index, frames - 1);
  EXPECT_GT(status.dropped, frames / 2);
  EXPECT_LE(status.dropped_while_learning, status.dropped);
  EXPECT_EQ(status.valid, status.frames);
  expect_order(live.tracking, status.dropped);
  ASSERT_GT(live.delays_s.size(), 4u);
  // With a queue the last frame would be some 3 s late. The slack is for a busy machine.
  for (const double delay_s : live.delays_s) EXPECT_LT(delay_s, work_s + 0.02 + 1.0);
  EXPECT_GE(live.delays_s.back(), work_s);
}

TEST(TrackLive, EndsWhenItIsToldTo) {
  capture::LatestFrame source = camera(100000);
  LiveOptions options;
  options.seconds = 0.6;
  const auto start = Clock::now();
  const LiveTracking live = track_live(source, expression::canonical_model(), quick(), options);
  EXPECT_LT(Clock::now() - start, 10s);
  EXPECT_LT(live.tracking.frames.back().time_s, 1.2) << "0.6 s, and what a busy machine adds";

  capture::LatestFrame again = camera(100000);
  LiveOptions until_asked;
  std::size_t reported = 0;
  until_asked.status = [&](const LiveStatus& status) {
    ++reported;
    EXPECT_EQ(status.held_back + status.frames, reported) << "nothing queues up beside these";
    EXPECT_LT(status.held_back, 4u);
  };
  until_asked.stop = [&] { return reported == 3; };  // while frames are held back
  const LiveTracking short_one =
      track_live(again, expression::canonical_model(), quick(), until_asked);
  EXPECT_EQ(short_one.tracking.frames.size(), 3u) << "what was held back is given";
  EXPECT_EQ(short_one.status.valid, 3u);
  EXPECT_TRUE(short_one.delays_s.empty());
}

TEST(TrackLive, WithoutAFaceNothingIsHeldBack) {
  capture::LatestFrame source(
      std::make_unique<Camera>(cv::Mat(320, 320, CV_8UC3, cv::Scalar(90, 90, 90)), 12));
  LiveOptions options;
  std::size_t reported = 0;
  options.status = [&](const LiveStatus& status) {
    ++reported;
    EXPECT_EQ(status.held_back, 0u);
    EXPECT_EQ(status.valid, 0u);
  };
  EXPECT_THROW(track_live(source, expression::canonical_model(), quick(), options), InputError);
  EXPECT_GT(reported, 0u);
}

TEST(TrackLive, ErrorsOfTheTrackerNameTheRecordingWhereItIsKnown) {
  const auto said = [](const InputError& error) {
    return std::string(about_recording(error, "me.mp4").what());
  };
  EXPECT_EQ(said(InputError("tracking", "no face")), "me.mp4: no face");
  EXPECT_EQ(said(InputError("camera.toml", "no fx")), "camera.toml: no fx");
  EXPECT_EQ(said(InputError("a.png", "tracking: torn")), "a.png: tracking: torn");
}

}  // namespace
}  // namespace hyperex::tracking
