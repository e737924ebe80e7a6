// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/memory.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <tbb/task_arena.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <stdexcept>
#include <vector>

#include "hyperex/core/loaded_symbol.hpp"

namespace hyperex {
namespace {

using Take = void* (*)(int);
using Return = void (*)(void*);
using Parallel = void (*)(void (*)(void*), void*, unsigned, unsigned);

// Memory of a run of a coarse face (measured), and of OpenBLAS for each thread that calls it.
constexpr std::size_t kFaceBytes = std::size_t(512) << 20, kBufferBytes = std::size_t(128) << 20;

// One for each thread that computes at once and one for a thread that starts them.
std::size_t blas_buffers() {
  return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 1;
}

void require_memory(std::size_t bytes) {
  void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED)
    throw std::runtime_error(fmt::format(
        "there is not enough memory: {} MiB may not be taken (see ulimit -v)", bytes >> 20));
  ::munmap(mapped, bytes);
}

// OpenBLAS takes a buffer when a thread calls it and none is free, keeps it for later calls, and
// tries for ever where there is no memory.
void take_blas_buffers(std::size_t count) {
  const auto take = loaded_symbol<Take>("blas_memory_alloc");
  const auto give_back = loaded_symbol<Return>("blas_memory_free");
  if (!take || !give_back) return;
  std::vector<void*> buffers(count);
  for (auto& buffer : buffers) buffer = take(0);
  for (auto* buffer : buffers) give_back(buffer);
}

}  // namespace

void give_back_freed_memory() {
#ifdef __GLIBC__
  ::malloc_trim(0);
#endif
}

void take_library_memory() {
  require_memory(kFaceBytes + blas_buffers() * kBufferBytes);
  take_blas_buffers(blas_buffers());
  if (const auto parallel = loaded_symbol<Parallel>("GOMP_parallel"))
    parallel([](void*) {}, nullptr, 0, 0);
}

}  // namespace hyperex
