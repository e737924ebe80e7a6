// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/degraded_source.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace hyperex::test {
namespace {

constexpr int kBehind = 110;  // level of the wall behind the picture

/// Columns by which the picture of a frame is moved to the right.
int slide_px(const FrameSpan& away, std::size_t index, int width_px) {
  const double at = (double(index - away.first) + 1) / (double(away.count) + 1);  // 0 to 1
  return int(std::lround(width_px * std::min(1.0, 3 * std::min(at, 1 - at))));
}

void slide(cv::Mat& picture, int by_px, const cv::Scalar& behind) {
  cv::Mat moved(picture.size(), picture.type(), behind);
  const int left = picture.cols - by_px;
  if (left > 0)
    picture(cv::Rect(0, 0, left, picture.rows)).copyTo(moved(cv::Rect(by_px, 0, left, moved.rows)));
  picture = moved;
}

class DegradedSource : public capture::FrameSource {
 public:
  DegradedSource(std::unique_ptr<capture::FrameSource> source, const Degradation& degradation)
      : source_(std::move(source)), done_(degradation) {}

  const capture::Intrinsics& intrinsics() const override { return source_->intrinsics(); }
  bool has_depth() const override { return source_->has_depth() && !done_.without_depth; }
  bool live() const override { return source_->live(); }
  std::optional<std::size_t> frame_count() const override { return source_->frame_count(); }
  std::size_t dropped() const override { return source_->dropped(); }
  std::vector<std::string> notes() const override { return source_->notes(); }

  std::optional<capture::Frame> next() override {
    auto frame = source_->next();
    if (!frame) return frame;
    cv::RNG random(1 + frame->index);
    if (done_.without_depth) frame->depth_m.release();
    if (!frame->depth_m.empty()) spoil_depth(*frame, random);
    if (!frame->colour.empty()) spoil_colour(*frame, random);
    return frame;
  }

 private:
  void spoil_depth(capture::Frame& frame, cv::RNG& random) const {
    if (done_.depth_holes > 0) {
      cv::Mat chance(frame.depth_m.size(), CV_32F);
      random.fill(chance, cv::RNG::UNIFORM, 0, 1);
      frame.depth_m.setTo(0, chance < done_.depth_holes);
    }
    if (done_.away.holds(frame.index))
      slide(frame.depth_m, slide_px(done_.away, frame.index, frame.depth_m.cols), 0);
  }

  void spoil_colour(capture::Frame& frame, cv::RNG& random) const {
    if (done_.brightness != 1 || done_.noise_levels > 0) {
      cv::Mat levels, noise(frame.colour.size(), CV_32FC3);
      random.fill(noise, cv::RNG::NORMAL, 0, done_.noise_levels);
      frame.colour.convertTo(levels, CV_32F, done_.brightness);
      levels += noise;
      levels.convertTo(frame.colour, CV_8U);
    }
    if (done_.black.holds(frame.index)) frame.colour.setTo(0);
    if (done_.away.holds(frame.index))
      slide(frame.colour, slide_px(done_.away, frame.index, frame.colour.cols),
            cv::Scalar::all(kBehind));
  }

  std::unique_ptr<capture::FrameSource> source_;
  Degradation done_;
};

}  // namespace

std::unique_ptr<capture::FrameSource> degraded(std::unique_ptr<capture::FrameSource> source,
                                               const Degradation& degradation) {
  return std::make_unique<DegradedSource>(std::move(source), degradation);
}

}  // namespace hyperex::test
