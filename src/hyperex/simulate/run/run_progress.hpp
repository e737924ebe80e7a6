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
  /// What follows is the part of the run between these shares of it, from 0 to 1. Nothing of it is
  /// done yet.
  void begin_part(double from, double to);
  /// The share of the part that is done, from 0 to 1. Throws Cancelled likewise.
  void report(double share);
  /// A part of work whose length is not known is done: a little of the way to `share`, likewise.
  void report_towards(double share) {
    report(share > done_ ? done_ + 0.03 * (share - done_) : done_);
  }
  double done() const { return done_; }
  /// Calls `body` for 0 to count - 1, in parallel. It takes half of the part's rest.
  void for_frames(std::size_t count, const std::function<void(std::size_t)>& body);
  bool skin_alone() const { return callbacks_.skin_alone; }

 private:
  RunCallbacks callbacks_;
  double from_ = 0, to_ = 1;  // of the part
  double done_ = 0;
};

}  // namespace hyperex::simulate
