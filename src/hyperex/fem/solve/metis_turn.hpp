// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <mutex>

namespace hyperex::fem {

/// To be held while METIS orders a graph. It seeds and draws from C's one rand(): two orderings at
/// the same time would share its numbers, and with them the last bits of all results would change
/// from run to run.
inline std::unique_lock<std::mutex> metis_turn() {
  static std::mutex turn;
  return std::unique_lock(turn);
}

}  // namespace hyperex::fem
