// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/mirrored.hpp"

#include <opencv2/core.hpp>

namespace hyperex::capture {

namespace {

/// Returns a new picture, because the given one may be in use elsewhere.
cv::Mat flipped(const cv::Mat& picture) {
  cv::Mat turned;
  if (!picture.empty()) cv::flip(picture, turned, 1);
  return turned;
}

}  // namespace

Mirrored::Mirrored(std::unique_ptr<FrameSource> source)
    : source_(std::move(source)), intrinsics_(source_->intrinsics()) {
  intrinsics_.cx_px = intrinsics_.width_px - 1 - intrinsics_.cx_px;
}

std::optional<Frame> Mirrored::next() {
  auto frame = source_->next();
  if (!frame) return frame;
  frame->colour = flipped(frame->colour);
  frame->depth_m = flipped(frame->depth_m);
  return frame;
}

std::vector<std::string> Mirrored::notes() const {
  auto notes = source_->notes();
  notes.push_back("the pictures are mirrored: they were turned back");
  return notes;
}

}  // namespace hyperex::capture
