// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/remarks.hpp"

#include <mutex>
#include <utility>

namespace hyperex {
namespace {
struct ListenerSlot {
  std::mutex mutex;
  RemarkListener listener;
};
ListenerSlot& listener_slot() {
  static ListenerSlot one;
  return one;
}
}  // namespace

void listen_to_remarks(RemarkListener listener) {
  const std::lock_guard lock(listener_slot().mutex);
  listener_slot().listener = std::move(listener);
}

void remark(Remark kind, const std::string& sentence) {
  // Called without the mutex: a listener may wait for a lock that another remarking thread holds.
  const RemarkListener listener = [] {
    const std::lock_guard lock(listener_slot().mutex);
    return listener_slot().listener;
  }();
  if (listener) listener(kind, sentence);
}

}  // namespace hyperex
