// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/buffered.hpp"

#include <algorithm>

namespace hyperex::capture {

Buffered::Buffered(std::unique_ptr<FrameSource> source, std::size_t capacity, WhenFull when_full)
    : source_(std::move(source)),
      capacity_(std::max<std::size_t>(capacity, 1)),
      when_full_(when_full),
      notes_(source_->notes()),
      worker_([this] { work(); }) {}

Buffered::~Buffered() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_all();
  worker_.join();
}

void Buffered::work() {
  while (true) {
    std::optional<Frame> frame;
    std::exception_ptr error;
    try {
      frame = source_->next();
      if (frame) frame->arrived = std::chrono::steady_clock::now();
    } catch (...) {
      error = std::current_exception();
    }
    std::unique_lock lock(mutex_);
    if (!frame) {
      error_ = error;
      notes_ = source_->notes();
      ended_ = true;
      changed_.notify_all();
      return;
    }
    if (waiting_.size() >= capacity_ && when_full_ == WhenFull::drop_oldest) {
      waiting_.pop_front();
      ++dropped_;
    }
    changed_.wait(lock, [this] { return stopping_ || waiting_.size() < capacity_; });
    if (stopping_) return;
    waiting_.push_back(std::move(*frame));
    changed_.notify_all();
  }
}

std::optional<Frame> Buffered::next() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return ended_ || !waiting_.empty(); });
  if (waiting_.empty()) {
    if (const auto error = std::exchange(error_, nullptr)) std::rethrow_exception(error);
    return std::nullopt;
  }
  Frame frame = std::move(waiting_.front());
  waiting_.pop_front();
  changed_.notify_all();
  return frame;
}

std::size_t Buffered::dropped() const {
  const std::lock_guard lock(mutex_);
  return dropped_;
}

std::vector<std::string> Buffered::notes() const {
  const std::lock_guard lock(mutex_);
  return notes_;
}

std::unique_ptr<FrameSource> read_ahead(std::unique_ptr<FrameSource> source, std::size_t frames) {
  return std::make_unique<Buffered>(std::move(source), frames, Buffered::WhenFull::wait);
}

}  // namespace hyperex::capture
