// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/memory.hpp"

#include <gtest/gtest.h>
#ifdef __GLIBC__
#include <malloc.h>
#endif
#include <unistd.h>

#include <cstdio>
#include <memory>
#include <vector>

#include "support/sanitizers.hpp"

// Sanitizers keep freed memory themselves.
#if !defined(__GLIBC__) || HYPEREX_SANITIZED
#define HYPEREX_OTHER_ALLOCATOR
#endif

namespace hyperex {
namespace {

/// Resident memory of this process, MiB.
double resident_mib() {
  std::size_t all = 0, resident = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%zu %zu", &all, &resident) != 2) resident = 0;
    std::fclose(file);
  }
  return double(resident) * double(sysconf(_SC_PAGESIZE)) / (1 << 20);
}

TEST(FreedMemory, IsGivenBackToTheSystem) {
#if defined(HYPEREX_OTHER_ALLOCATOR)
  GTEST_SKIP() << "another allocator than that of the GNU C library";
#else
  // The program's own thresholds, with which the allocator keeps what is freed.
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  const double before = resident_mib();
  std::vector<std::unique_ptr<std::vector<char> > > held;
  for (int i = 0; i < 2000; ++i) held.push_back(std::make_unique<std::vector<char> >(100000, 'x'));
  const auto last = std::make_unique<std::vector<char> >(100000, 'x');  // the heap cannot shrink
  held.clear();
  EXPECT_GT(resident_mib(), before + 150);
  give_back_freed_memory();
  EXPECT_LT(resident_mib(), before + 20);
#endif
}

}  // namespace
}  // namespace hyperex
