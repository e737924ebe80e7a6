// SPDX-License-Identifier: GPL-3.0-or-later
#include "request_queue.hpp"

namespace hyperex::studio {

bool is_live(const Request& request) {
  return request.name == "ct_slice" ||
         (request.name == "set" && request.fields.at("live").get<bool>());
}

namespace {

/// Whether the effect of `request` is overwritten by `later`.
bool replaces(const Request& later, const Request& request) {
  if (!is_live(request) || later.name != request.name) return false;
  return request.name == "ct_slice" || later.fields.at("face") == request.fields.at("face");
}

}  // namespace

bool RequestQueue::push(Request request) {
  const std::lock_guard lock(mutex_);
  if (closed_ || waiting_.size() >= kMost) return false;
  waiting_.push_back(std::move(request));
  changed_.notify_one();
  return true;
}

std::optional<Request> RequestQueue::pop(std::chrono::milliseconds wait,
                                         std::vector<Request>& superseded) {
  std::unique_lock lock(mutex_);
  const auto ready = [&] { return closed_ || !waiting_.empty(); };
  if (wait == kForever)
    changed_.wait(lock, ready);
  else
    changed_.wait_for(lock, wait, ready);
  if (closed_ || waiting_.empty()) return std::nullopt;
  Request request = std::move(waiting_.front());
  waiting_.pop_front();
  while (!waiting_.empty() && replaces(waiting_.front(), request)) {
    superseded.push_back(std::move(request));
    request = std::move(waiting_.front());
    waiting_.pop_front();
  }
  return request;
}

bool RequestQueue::empty() const {
  const std::lock_guard lock(mutex_);
  return waiting_.empty();
}

void RequestQueue::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  changed_.notify_all();
}

bool RequestQueue::closed() const {
  const std::lock_guard lock(mutex_);
  return closed_;
}

}  // namespace hyperex::studio
