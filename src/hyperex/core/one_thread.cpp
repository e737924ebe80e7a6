// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/one_thread.hpp"

#include "hyperex/core/blas_kernels.hpp"
#include "hyperex/core/loaded_symbol.hpp"

namespace hyperex {

namespace {

using Set = void (*)(int);
using Get = int (*)();

/// Each program that solves links this file. Before main() none of its threads uses BLAS.
[[maybe_unused]] const std::string kernels = choose_blas_kernels();

}  // namespace

void keep_blas_to_one_thread() {
  if (const auto set = loaded_symbol<Set>("openblas_set_num_threads")) set(1);
}

OneOpenMpThread::OneOpenMpThread() {
  static const auto get = loaded_symbol<Get>("omp_get_max_active_levels");
  static const auto set = loaded_symbol<Set>("omp_set_max_active_levels");
  if (!get || !set) return;
  levels_before_ = get();
  set(0);
}

OneOpenMpThread::~OneOpenMpThread() {
  static const auto set = loaded_symbol<Set>("omp_set_max_active_levels");
  if (set && levels_before_ >= 0) set(levels_before_);
}

}  // namespace hyperex
