// SPDX-License-Identifier: GPL-3.0-or-later
// Where no memory is left, as many threads as compute at once still multiply.
#include <cblas.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <barrier>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "hyperex/core/memory.hpp"
#include "hyperex/core/one_thread.hpp"
#include "support/sanitizers.hpp"

namespace hyperex {
namespace {

/// Allows no more address space than is taken.
void allow_no_more_memory() {
  std::size_t pages = 0;
  std::FILE* const file = std::fopen("/proc/self/statm", "r");
  if (!file || std::fscanf(file, "%zu", &pages) != 1) std::_Exit(3);
  std::fclose(file);
  rlimit space{};
  if (::getrlimit(RLIMIT_AS, &space) != 0) std::_Exit(3);
  space.rlim_cur = pages * static_cast<std::size_t>(::sysconf(_SC_PAGESIZE));
  if (::setrlimit(RLIMIT_AS, &space) != 0) std::_Exit(3);
}

void multiply_without_memory() {
  ::alarm(30);  // a library that tries for ever is ended
  keep_blas_to_one_thread();
  take_library_memory();
  const int count = tbb::this_task_arena::max_concurrency();
  constexpr int n = 200;
  const std::vector<double> a(n * n, 1.0);
  std::vector<std::vector<double>> products(count, std::vector<double>(n * n));
  std::barrier together(count + 1);
  std::vector<std::thread> threads;
  for (auto& product : products)
    threads.emplace_back([&] {
      together.arrive_and_wait();
      together.arrive_and_wait();
      for (int repeat = 0; repeat < 100; ++repeat)
        cblas_dgemm(CblasColMajor, CblasNoTrans, CblasNoTrans, n, n, n, 1, a.data(), n, a.data(), n,
                    0, product.data(), n);
    });
  together.arrive_and_wait();
  allow_no_more_memory();
  together.arrive_and_wait();
  for (auto& thread : threads) thread.join();
  for (const auto& product : products)
    if (product.back() != n) std::_Exit(4);
  std::_Exit(0);
}

TEST(BlasMemory, IsTakenForAllThreadsBeforehand) {
#if HYPEREX_SANITIZED
  GTEST_SKIP() << "a sanitizer takes memory itself";
#endif
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(multiply_without_memory(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace hyperex
