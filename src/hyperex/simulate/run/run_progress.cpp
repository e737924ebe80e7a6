// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/run/run_progress.hpp"

#include <atomic>
#include <thread>

#include "hyperex/core/run_together.hpp"

namespace hyperex::simulate {

void RunProgress::begin(const RunCallbacks& callbacks) {
  callbacks_ = callbacks;
}

void RunProgress::throw_if_cancelled() const {
  if (callbacks_.cancelled && callbacks_.cancelled()) throw Cancelled();
}

void RunProgress::begin_part(double from, double to) {
  from_ = from;
  to_ = to;
  done_ = 0;
}

void RunProgress::report(double share) {
  throw_if_cancelled();
  done_ = share;
  if (callbacks_.progress) callbacks_.progress(from_ + share * (to_ - from_));
}

void RunProgress::for_frames(std::size_t count, const std::function<void(std::size_t)>& body) {
  const auto caller = std::this_thread::get_id();  // on which callbacks are called
  const double from = done_, step = 0.5 * (1 - from) / static_cast<double>(count);
  std::atomic<std::size_t> done{0};
  run_each(count, [&](std::size_t i) {
    body(i);
    const std::size_t now = ++done;
    if (std::this_thread::get_id() == caller) report(from + step * static_cast<double>(now));
  });
  report(from + step * static_cast<double>(count));
}

}  // namespace hyperex::simulate
