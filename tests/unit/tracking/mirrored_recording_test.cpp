// SPDX-License-Identifier: GPL-3.0-or-later
// A mirrored recording: left and right are swapped where the mirroring is not stated, and correct
// where it is.
#include <gtest/gtest.h>

#include <filesystem>
#include <opencv2/core.hpp>

#include "hyperex/capture/mirrored.hpp"
#include "hyperex/capture/open_source.hpp"
#include "hyperex/tracking/fit/track_source.hpp"

namespace hyperex::tracking {
namespace {

constexpr std::size_t kFrames = 50;

/// The first frames of a recording, mirrored or not.
class Recorded : public capture::FrameSource {
 public:
  Recorded(const std::string& folder, bool in_a_mirror)
      : source_(capture::open_source(folder)),
        camera_(source_->intrinsics()),
        in_a_mirror_(in_a_mirror) {
    if (in_a_mirror) camera_.cx_px = camera_.width_px - 1 - camera_.cx_px;
  }
  const capture::Intrinsics& intrinsics() const override { return camera_; }
  bool has_depth() const override { return source_->has_depth(); }
  bool live() const override { return false; }
  std::optional<std::size_t> frame_count() const override { return kFrames; }
  std::optional<capture::Frame> next() override {
    if (given_++ == kFrames) return std::nullopt;
    auto frame = source_->next();
    if (frame && in_a_mirror_) {
      // Not with cv::flip, which Mirrored uses.
      frame->colour = columns_reversed<cv::Vec3b>(frame->colour);
      frame->depth_m = columns_reversed<float>(frame->depth_m);
    }
    return frame;
  }

 private:
  template <typename Pixel>
  static cv::Mat columns_reversed(const cv::Mat& picture) {
    cv::Mat out(picture.size(), picture.type());
    for (int y = 0; y < picture.rows; ++y)
      for (int x = 0; x < picture.cols; ++x)
        out.at<Pixel>(y, x) = picture.at<Pixel>(y, picture.cols - 1 - x);
    return out;
  }

  std::unique_ptr<capture::FrameSource> source_;
  capture::Intrinsics camera_;
  bool in_a_mirror_;
  std::size_t given_ = 0;
};

/// Yaw (to the subject's left) and the difference of an action unit, left minus right, in each
/// frame.
struct Sides {
  Eigen::VectorXd yaw, difference;
};
Sides sides_of(const Tracking& tracking) {
  const expression::FaceModel& model = expression::canonical_model();
  const int left = model.animation_unit("mouthSmile_L"),
            right = model.animation_unit("mouthSmile_R");
  Sides sides{Eigen::VectorXd(tracking.frames.size()), Eigen::VectorXd(tracking.frames.size())};
  for (std::size_t k = 0; k < tracking.frames.size(); ++k) {
    const TrackedFrame& frame = tracking.frames[k];
    EXPECT_TRUE(frame.valid) << k;
    const Vec3 forward = frame.camera_from_head.linear().col(2);
    sides.yaw[Eigen::Index(k)] = std::atan2(forward.x(), -forward.z());
    sides.difference[Eigen::Index(k)] = frame.weights[left] - frame.weights[right];
  }
  return sides;
}

TEST(MirroredRecording, LeftStaysLeftWhereItIsSaid) {
  const std::string folder = HYPEREX_SHARED_DIR "/data/rgbd/subject_A_talk";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  Recorded plain(folder, false), unsaid(folder, true);
  capture::Mirrored said(std::make_unique<Recorded>(folder, true));
  const expression::FaceModel& model = expression::canonical_model();
  const Tracking truth = track(plain, model), turned_back = track(said, model);
  ASSERT_EQ(truth.frames.size(), kFrames);
  ASSERT_EQ(turned_back.frames.size(), kFrames);
  for (std::size_t k = 0; k < kFrames; ++k)
    EXPECT_TRUE(turned_back.frames[k].weights == truth.frames[k].weights) << k;
  // What the option is for: unsaid, the head turns the other way.
  const Sides right = sides_of(truth), wrong = sides_of(track(unsaid, model));
  EXPECT_LT(right.yaw.dot(wrong.yaw), -0.9 * right.yaw.norm() * wrong.yaw.norm());
  EXPECT_LT(right.difference.dot(wrong.difference),
            -0.5 * right.difference.norm() * wrong.difference.norm());
}

}  // namespace
}  // namespace hyperex::tracking
