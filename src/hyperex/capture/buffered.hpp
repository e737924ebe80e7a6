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

/// Reads a source on a thread of its own, through a bounded queue. If the consumer is slower than
/// the source, either the worker thread waits (read_ahead), or the oldest frame in the queue is
/// dropped and counted (LatestFrame).
class Buffered : public FrameSource {
 public:
  enum class WhenFull { wait, drop_oldest };

  /// The queue holds at most `capacity` >= 1 frames, in addition to the one being read.
  Buffered(std::unique_ptr<FrameSource> source, std::size_t capacity, WhenFull when_full);
  /// Waits until the worker has finished reading its current frame.
  ~Buffered() override;

  const Intrinsics& intrinsics() const override { return source_->intrinsics(); }
  bool has_depth() const override { return source_->has_depth(); }
  bool live() const override { return source_->live(); }
  std::optional<std::size_t> frame_count() const override { return source_->frame_count(); }
  /// An exception of the source is rethrown here, after all frames that were read before it.
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

/// Reads and decodes up to `frames` frames in advance on another thread. No frame is lost.
std::unique_ptr<FrameSource> read_ahead(std::unique_ptr<FrameSource> source, std::size_t frames);

/// For live sources. next() returns the newest frame; if it has been returned already, next() waits
/// for another one. A slow consumer is never more than one frame behind the camera. The frames in
/// between are dropped and counted.
class LatestFrame : public Buffered {
 public:
  explicit LatestFrame(std::unique_ptr<FrameSource> source)
      : Buffered(std::move(source), 1, WhenFull::drop_oldest) {}
};

}  // namespace hyperex::capture
