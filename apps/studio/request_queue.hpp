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

/// Whether a request is one of many that a slider makes while it is held.
bool is_live(const Request& request);

/// Requests between the network's thread and the one that answers. Of live changes of one face, one
/// after the other, the last one counts.
class RequestQueue {
 public:
  static constexpr std::size_t kMost = 256;
  static constexpr std::chrono::milliseconds kForever = std::chrono::milliseconds::max();

  /// False where so many wait that this one is refused.
  bool push(Request request);
  /// The next one; waits so long for it. Requests that a later one made needless are put into
  /// `superseded`. Nothing where none came or the queue is closed.
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
