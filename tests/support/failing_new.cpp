// SPDX-License-Identifier: GPL-3.0-or-later
// Preloaded into the program (LD_PRELOAD), this lets one allocation by `new` fail:
//   FAILING_NEW=N      the N-th and, where FAILING_NEW_FOR=M is given, the M - 1 after it
//   FAILING_NEW_COUNT  a file that takes the number of allocations at the end
// A limit of memory makes large allocations fail; this makes any allocation fail.
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <new>

namespace {

std::atomic<long> count{0};

long number_of(const char* variable) {
  const char* const text = std::getenv(variable);
  return text ? std::atol(text) : 0;
}

struct Course {
  long first = number_of("FAILING_NEW");
  long last = first + std::max(1L, number_of("FAILING_NEW_FOR")) - 1;
  ~Course() {
    const char* const file = std::getenv("FAILING_NEW_COUNT");
    std::FILE* const out = file ? std::fopen(file, "w") : nullptr;
    if (!out) return;
    std::fprintf(out, "%ld", count.load());
    std::fclose(out);
  }
};

bool fails() {
  static const Course course;
  const long now = ++count;
  return course.first > 0 && now >= course.first && now <= course.last;
}

void* allocated(std::size_t bytes, std::size_t alignment) {
  if (fails()) return nullptr;
  if (bytes == 0) bytes = 1;
  if (alignment <= alignof(std::max_align_t)) return std::malloc(bytes);
  return std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
}

void* allocated_or_throw(std::size_t bytes, std::size_t alignment) {
  void* const at = allocated(bytes, alignment);
  if (!at) throw std::bad_alloc();
  return at;
}

}  // namespace

void* operator new(std::size_t bytes) {
  return allocated_or_throw(bytes, 0);
}
void* operator new[](std::size_t bytes) {
  return allocated_or_throw(bytes, 0);
}
void* operator new(std::size_t bytes, std::align_val_t alignment) {
  return allocated_or_throw(bytes, std::size_t(alignment));
}
void* operator new[](std::size_t bytes, std::align_val_t alignment) {
  return allocated_or_throw(bytes, std::size_t(alignment));
}
void* operator new(std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocated(bytes, 0);
}
void* operator new[](std::size_t bytes, const std::nothrow_t&) noexcept {
  return allocated(bytes, 0);
}
void operator delete(void* at) noexcept {
  std::free(at);
}
void operator delete[](void* at) noexcept {
  std::free(at);
}
void operator delete(void* at, std::size_t) noexcept {
  std::free(at);
}
void operator delete[](void* at, std::size_t) noexcept {
  std::free(at);
}
void operator delete(void* at, std::align_val_t) noexcept {
  std::free(at);
}
void operator delete[](void* at, std::align_val_t) noexcept {
  std::free(at);
}
void operator delete(void* at, std::size_t, std::align_val_t) noexcept {
  std::free(at);
}
void operator delete[](void* at, std::size_t, std::align_val_t) noexcept {
  std::free(at);
}
