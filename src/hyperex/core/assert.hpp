// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

namespace hyperex {

/// Writes "FILE:LINE: FUNCTION: bug in hyperex: CONDITION does not hold" to standard error and ends
/// the program by SIGABRT.
[[noreturn, gnu::cold]] void assertion_failed(const char* condition, const char* file, int line,
                                              const char* function);

}  // namespace hyperex

/// Ends the program where the condition does not hold: a bug of ours, never a mistake in the input.
/// Unlike assert() it stays in optimised builds, which users run and most tests see; NDEBUG keeps
/// the assertions of Eigen, CGAL and the readers' libraries out of those. Not for innermost loops.
#define HX_ASSERT(...)            \
  (static_cast<bool>(__VA_ARGS__) \
       ? static_cast<void>(0)     \
       : ::hyperex::assertion_failed(#__VA_ARGS__, __FILE__, __LINE__, __func__))
