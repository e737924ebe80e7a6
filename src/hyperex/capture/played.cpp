// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/played.hpp"

#include <chrono>
#include <thread>

namespace hyperex::capture {
namespace {
using Clock = std::chrono::steady_clock;

class Played : public FrameSource {
 public:
  explicit Played(std::unique_ptr<FrameSource> recording) : recording_(std::move(recording)) {}
  const Intrinsics& intrinsics() const override { return recording_->intrinsics(); }
  bool has_depth() const override { return recording_->has_depth(); }
  bool live() const override { return true; }
  std::optional<std::size_t> frame_count() const override { return recording_->frame_count(); }
  std::vector<std::string> notes() const override { return recording_->notes(); }

  std::optional<Frame> next() override {
    auto frame = recording_->next();
    if (!frame || !frame->valid) return frame;
    if (!start_) start_ = {Clock::now(), frame->time_s};
    const std::chrono::duration<double> since_start(frame->time_s - start_->second);
    std::this_thread::sleep_until(start_->first +
                                  std::chrono::duration_cast<Clock::duration>(since_start));
    return frame;
  }

 private:
  std::unique_ptr<FrameSource> recording_;
  // wall-clock time and time_s of the first frame.
  std::optional<std::pair<Clock::time_point, double>> start_;
};

}  // namespace

std::unique_ptr<FrameSource> play(std::unique_ptr<FrameSource> recording) {
  return std::make_unique<Played>(std::move(recording));
}

}  // namespace hyperex::capture
