// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/memory.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <stdexcept>
#include <vector>

#include "hyperex/core/loaded_symbol.hpp"

namespace hyperex {
namespace {

using Gemm = void (*)(const char*, const char*, const int*, const int*, const int*, const double*,
                      const double*, const int*, const double*, const int*, const double*, double*,
                      const int*);
using Parallel = void (*)(void (*)(void*), void*, unsigned, unsigned);

void require_memory() {
  constexpr std::size_t bytes = std::size_t(768) << 20;
  void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED)
    throw std::runtime_error(fmt::format(
        "there is not enough memory: {} MiB may not be taken (see ulimit -v)", bytes >> 20));
  ::munmap(mapped, bytes);
}

}  // namespace

void give_back_freed_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void take_library_memory() {
  require_memory();
  if (const auto multiply = loaded_symbol<Gemm>("dgemm_")) {
    constexpr int n = 64;  // smaller ones go another way, without the memory
    const double one = 1, zero = 0;
    const std::vector<double> a(n * n, 1.0);
    std::vector<double> product(n * n);
    multiply("N", "N", &n, &n, &n, &one, a.data(), &n, a.data(), &n, &zero, product.data(), &n);
  }
  if (const auto parallel = loaded_symbol<Parallel>("GOMP_parallel"))
    parallel([](void*) {}, nullptr, 0, 0);
}

}  // namespace hyperex
