// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "protocol.hpp"

namespace hyperex::studio {

/// Whether the request comes from a slider that is being dragged: a change, or a slice of a CT.
bool is_live(const Request& request);

/// Requests on their way from the network's thread to the thread that answers them. Of consecutive
/// live changes of one face, and of consecutive slices, only the last is answered.
class RequestQueue {
 public:
  static constexpr std::size_t kMost = 256;
  static constexpr std::chrono::milliseconds kForever = std::chrono::milliseconds::max();

  /// Returns false where the queue is full or closed.
  bool push(Request request);
  /// The next request, after waiting for at most `wait`. Appends requests that a later one has
  /// replaced to `superseded`. Empty where none came or the queue is closed.
  std::optional<Request> pop(std::chrono::milliseconds wait, std::vector<Request>& superseded);
  bool empty() const;
  void close();
  bool closed() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Request> waiting_;
  bool closed_ = false;
};

}  // namespace hyperex::studio
