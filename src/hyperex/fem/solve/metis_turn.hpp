// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <mutex>

namespace hyperex::fem {

/// Lock to be held while METIS orders a graph. METIS seeds and uses rand() of the C library, which
/// is global. If two orderings ran at the same time, they would share its numbers, and the last
/// bits of all results would change from run to run.
inline std::unique_lock<std::mutex> metis_turn() {
  static std::mutex turn;
  return std::unique_lock(turn);
}

}  // namespace hyperex::fem
