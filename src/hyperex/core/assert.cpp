// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/assert.hpp"

#include <cstdio>
#include <cstdlib>

namespace hyperex {

void assertion_failed(const char* condition, const char* file, int line, const char* function) {
  std::fprintf(stderr, "%s:%d: %s: bug in hyperex: %s does not hold\n", file, line, function,
               condition);
  std::abort();
}

}  // namespace hyperex
