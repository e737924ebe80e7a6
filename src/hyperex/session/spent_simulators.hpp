// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <memory>
#include <mutex>
#include <vector>

#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::session {

/// Finished simulators whose factors can be reused. Thread-safe.
class SpentSimulators {
 public:
  void give(std::shared_ptr<simulate::Simulator> spent) {
    if (!spent) return;
    const std::lock_guard lock(mutex_);
    spent_.push_back(std::move(spent));
  }
  /// Null where there is none.
  std::shared_ptr<simulate::Simulator> take() {
    const std::lock_guard lock(mutex_);
    if (spent_.empty()) return nullptr;
    std::shared_ptr<simulate::Simulator> one = std::move(spent_.back());
    spent_.pop_back();
    return one;
  }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<simulate::Simulator>> spent_;
};

}  // namespace hyperex::session
