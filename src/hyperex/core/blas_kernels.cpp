// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/blas_kernels.hpp"

#include <cstdlib>

#include "hyperex/core/loaded_symbol.hpp"

namespace hyperex {

namespace {

/// OpenBLAS reads it when it chooses its kernels.
constexpr const char* kChoice = "OPENBLAS_CORETYPE";
constexpr const char* kFallback = "Prescott";  // for SSE3

std::string name_in_use() {
  const auto name = loaded_symbol<char* (*)()>("openblas_get_corename");
  return name ? name() : "";
}

/// The fastest kernels that this processor can run; null: no better ones than the fallback.
const char* best_kernels() {
#if defined(__x86_64__)
  __builtin_cpu_init();  // this may run before main()
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl"))
    return "SkylakeX";
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) return "Haswell";
#endif
  return nullptr;
}

}  // namespace

bool take_blas_kernels(const std::string& name) {
  const auto leave = loaded_symbol<void (*)()>("gotoblas_dynamic_quit");
  const auto choose = loaded_symbol<void (*)()>("gotoblas_dynamic_init");
  if (!leave || !choose) return false;
  // Threads of OpenBLAS that start meanwhile read the variable, too, and choose the same.
  ::setenv(kChoice, name.c_str(), 1);
  leave();
  choose();
  ::unsetenv(kChoice);
  return true;
}

std::string choose_blas_kernels() {
  const char* const best = best_kernels();
  if (best && !std::getenv(kChoice) && name_in_use() == kFallback) take_blas_kernels(best);
  return name_in_use();
}

}  // namespace hyperex
