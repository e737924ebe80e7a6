// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>

#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// Restores the pictures of a source that mirrors them. Colour and depth are flipped from left to
/// right, and so is the camera's principal point (u -> width - 1 - u). Everything else is passed on
/// unchanged.
class Mirrored : public FrameSource {
 public:
  explicit Mirrored(std::unique_ptr<FrameSource> source);

  const Intrinsics& intrinsics() const override { return intrinsics_; }
  bool has_depth() const override { return source_->has_depth(); }
  bool live() const override { return source_->live(); }
  std::optional<std::size_t> frame_count() const override { return source_->frame_count(); }
  std::optional<Frame> next() override;
  std::size_t dropped() const override { return source_->dropped(); }
  std::vector<std::string> notes() const override;

 private:
  std::unique_ptr<FrameSource> source_;
  Intrinsics intrinsics_;
};

}  // namespace hyperex::capture
