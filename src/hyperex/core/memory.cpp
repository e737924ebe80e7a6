// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/memory.hpp"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <algorithm>
#include <fstream>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "hyperex/core/loaded_symbol.hpp"
#include "hyperex/core/size_text.hpp"

namespace hyperex {
namespace {

using Take = void* (*)(int);
using Return = void (*)(void*);
using Parallel = void (*)(void (*)(void*), void*, unsigned, unsigned);

// Memory of a run of a coarse face (measured), and of OpenBLAS for each thread that calls it.
constexpr std::size_t kFaceBytes = std::size_t(512) << 20, kBufferBytes = std::size_t(128) << 20;

constexpr double kWhereUnknownBytes = 4.0 * (1ULL << 30U);

// One for each thread that computes at once and one for a thread that starts them.
std::size_t blas_buffers() {
  return static_cast<std::size_t>(tbb::this_task_arena::max_concurrency()) + 1;
}

void require_memory(std::size_t bytes) {
  void* const mapped = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                              MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (mapped == MAP_FAILED)
    throw std::runtime_error(
        fmt::format("there is not enough memory: {} may not be taken (see ulimit -v)",
                    size_text(double(bytes))));
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

std::optional<double> number_in(const char* file) {
  std::ifstream in(file);
  double value = 0;
  if (in >> value) return value;
  return std::nullopt;  // the file may contain "max", for example
}

/// The value of the line that begins with `key`, as in /proc/meminfo.
std::optional<double> value_of(const char* file, std::string_view key) {
  std::ifstream in(file);
  for (std::string name, line; in >> name; std::getline(in, line))
    if (double value = 0; name == key && in >> value) return value;
  return std::nullopt;
}

/// The memory that the control group still grants. It counts cached files as used, but the kernel
/// releases them when memory is needed.
std::optional<double> group_memory_bytes() {
  const auto limit = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (!limit || !used) return std::nullopt;
  constexpr const char* stat = "/sys/fs/cgroup/memory.stat";
  const double cached =
      value_of(stat, "inactive_file").value_or(0) + value_of(stat, "active_file").value_or(0);
  return std::max(0.0, *limit - std::max(0.0, *used - cached));
}

/// The address space that `ulimit -v` still grants.
std::optional<double> address_space_bytes() {
  rlimit space{};
  const auto used_pages = number_in("/proc/self/statm");
  if (getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur == RLIM_INFINITY || !used_pages)
    return std::nullopt;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return std::max(0.0, static_cast<double>(space.rlim_cur) - *used_pages * page);
}

}  // namespace

double available_memory_bytes() {
  const auto free_kib = value_of("/proc/meminfo", "MemAvailable:");
  double available = free_kib ? 1024 * *free_kib : kWhereUnknownBytes;
  for (const auto& granted : {group_memory_bytes(), address_space_bytes()})
    if (granted) available = std::min(available, *granted);
  return available;
}

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
