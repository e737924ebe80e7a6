// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <condition_variable>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "hyperex/capture/source.hpp"

namespace hyperex::capture {

/// A source read on a thread of its own through a bounded queue. Where the consumer is slower than
/// the source, the worker waits (read_ahead) or the oldest waiting frame is dropped and counted
/// (LatestFrame).
class Buffered : public FrameSource {
 public:
  enum class WhenFull { wait, drop_oldest };

  /// `capacity` >= 1 frames wait at most, besides the one that the worker is reading.
  Buffered(std::unique_ptr<FrameSource> source, std::size_t capacity, WhenFull when_full);
  /// Waits for the frame that the worker is just reading.
  ~Buffered() override;

  const Intrinsics& intrinsics() const override { return source_->intrinsics(); }
  bool has_depth() const override { return source_->has_depth(); }
  bool live() const override { return source_->live(); }
  std::optional<std::size_t> frame_count() const override { return source_->frame_count(); }
  /// What the source throws comes out here, behind the frames read before.
  std::optional<Frame> next() override;
  std::size_t dropped() const override;
  std::vector<std::string> notes() const override;

 private:
  void work();

  std::unique_ptr<FrameSource> source_;
  const std::size_t capacity_;
  const WhenFull when_full_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Frame> waiting_;
  std::vector<std::string> notes_;
  std::exception_ptr error_;
  std::size_t dropped_ = 0;
  bool ended_ = false, stopping_ = false;
  std::thread worker_;
};

/// Decodes ahead, so that reading costs the consumer little. No frame is lost.
std::unique_ptr<FrameSource> read_ahead(std::unique_ptr<FrameSource> source, std::size_t frames);

/// For live sources: next() gives the newest frame, waiting for one where none has come since the
/// last. A slow consumer is never more than one frame behind the camera; the frames in between are
/// dropped and counted.
class LatestFrame : public Buffered {
 public:
  explicit LatestFrame(std::unique_ptr<FrameSource> source)
      : Buffered(std::move(source), 1, WhenFull::drop_oldest) {}
};

}  // namespace hyperex::capture
