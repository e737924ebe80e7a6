// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/run_both.hpp"

#include <tbb/parallel_invoke.h>

#include <exception>

namespace hyperex {

void run_both(const std::function<void()>& first, const std::function<void()>& second) {
  std::exception_ptr thrown[2];
  const auto caught = [](const std::function<void()>& work, std::exception_ptr& kept) {
    try {
      work();
    } catch (...) {
      kept = std::current_exception();
    }
  };
  tbb::parallel_invoke([&] { caught(first, thrown[0]); }, [&] { caught(second, thrown[1]); });
  for (const std::exception_ptr& one : thrown)
    if (one) std::rethrow_exception(one);
}

}  // namespace hyperex
