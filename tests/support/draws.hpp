// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cstdlib>

namespace hyperex::test {

/// How many made-up patients a test of coverage draws: HYPEREX_DRAWS, at least 20.
inline int draws() {
  const char* const text = std::getenv("HYPEREX_DRAWS");
  return text ? std::max(20, std::atoi(text)) : 20;
}

}  // namespace hyperex::test
