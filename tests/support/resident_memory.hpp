// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
// For tests of memory that is given back to the system. They skip where keep_freed_memory() is
// false.
#include <unistd.h>

#include <cstdio>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "support/sanitizers.hpp"

namespace hyperex::test {

/// Resident memory of this process, MiB.
inline double resident_mib() {
  std::size_t all = 0, resident = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%zu %zu", &all, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return double(resident) * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

/// From now on the allocator keeps what is freed, as that of the program does. False where the
/// allocator is not the GNU C library's, as with sanitizers.
inline bool keep_freed_memory() {
#if defined(__GLIBC__) && !HYPEREX_SANITIZED
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  return true;
#else
  return false;
#endif
}

}  // namespace hyperex::test
