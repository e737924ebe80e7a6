// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/run_together.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include <atomic>
#include <exception>

namespace hyperex {
namespace {

void rethrow_first(const std::vector<std::exception_ptr>& thrown) {
  for (const std::exception_ptr& one : thrown)
    if (one) std::rethrow_exception(one);
}

}  // namespace

void run_each(std::size_t count, const std::function<void(std::size_t)>& body) {
  std::vector<std::exception_ptr> thrown(count);
  std::atomic<bool> failed{false};
  tbb::parallel_for(std::size_t(0), count, [&](std::size_t i) {
    if (failed) return;
    try {
      body(i);
    } catch (...) {
      thrown[i] = std::current_exception();
      failed = true;
    }
  });
  rethrow_first(thrown);
}

void run_together(const std::vector<std::function<void()>>& all) {
  std::vector<std::exception_ptr> thrown(all.size());
  tbb::task_group group;
  // Submitted last to first, since a thread takes its newest task: so the first begins first.
  for (std::size_t i = all.size(); i-- > 0;)
    group.run([&, i] {
      try {
        // A thread that waits within one of them must not begin another meanwhile: it would have
        // to end that one first, and the others would idle.
        tbb::this_task_arena::isolate([&] { all[i](); });
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    });
  group.wait();
  rethrow_first(thrown);
}

}  // namespace hyperex
