// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>

namespace hyperex::simulate {

/// A time at which the skin is wanted, from the start of the motion.
struct FrameTime {
  double time_s;
  int frame;  ///< of the performance, or -1 - the index of a still
  bool is_still() const { return frame < 0; }
  std::size_t index() const { return static_cast<std::size_t>(is_still() ? -1 - frame : frame); }
};

}  // namespace hyperex::simulate
