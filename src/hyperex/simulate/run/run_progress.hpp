// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <functional>

#include "hyperex/simulate/run/simulator.hpp"

namespace hyperex::simulate {

/// How far a run is, and whether it is to end early.
class RunProgress {
 public:
  void begin(const RunCallbacks& callbacks);
  /// Throws Cancelled where the caller wants the run to end.
  void throw_if_cancelled() const;
  /// The share of the run that is done, from 0 to 1. Throws Cancelled likewise.
  void report(double share);
  /// The share of the remaining run that is done, likewise.
  void report_of_rest(double share) { report(done_ + share * (1 - done_)); }
  /// A part of work whose length is not known is done: a little of the way to `share`, likewise.
  void report_towards(double share) {
    report(share > done_ ? done_ + 0.03 * (share - done_) : done_);
  }
  double done() const { return done_; }
  /// Calls `body` for 0 to count - 1, in parallel. It takes half of the remaining progress.
  void for_frames(std::size_t count, const std::function<void(std::size_t)>& body);
  bool skin_alone() const { return callbacks_.skin_alone; }

 private:
  RunCallbacks callbacks_;
  double done_ = 0;
};

}  // namespace hyperex::simulate
