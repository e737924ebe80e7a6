// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/capture/faults.hpp"

#include <fmt/format.h>

#include "hyperex/core/error.hpp"

namespace hyperex::capture {

void FaultCount::add(const Frame& frame) {
  ++frames_;
  if (frame.valid) return;
  if (faulty_++ == 0) first_fault_ = frame.fault;
}

void FaultCount::check_at_end() const {
  if (frames_ == 0) throw InputError(source_ + ": holds no frame");
  if (10 * (frames_ - faulty_) >= frames_) return;
  throw InputError(fmt::format("{}: {} of {} frames cannot be used; the first: {}", source_,
                               faulty_, frames_, first_fault_));
}

}  // namespace hyperex::capture
