// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cstdlib>

namespace hyperex::test {

/// How many made-up patients a test of coverage draws: HYPEREX_DRAWS, else `usual`.
inline int draws(int usual = 20) {
  const char* const text = std::getenv("HYPEREX_DRAWS");
  return text ? std::max(1, std::atoi(text)) : usual;
}

}  // namespace hyperex::test
