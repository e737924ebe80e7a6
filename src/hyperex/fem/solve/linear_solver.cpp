// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/linear_solver.hpp"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string>

namespace hyperex::fem {
namespace {

std::optional<double> number_in(const char* file) {
  std::ifstream in(file);
  double value = 0;
  if (in >> value) return value;
  return std::nullopt;  // "max" among others
}

}  // namespace

LinearSolver pick_linear_solver(LinearSolver wanted, const FactorForecast& forecast,
                                double available_bytes) {
  const double stored = kStoredShare * forecast.entries;
  if (stored > kMostFactorEntries) return LinearSolver::iterative;
  if (wanted != LinearSolver::automatic) return wanted;
  const double bytes =
      stored * sizeof(double) * (1 + kStackShare) + kWorkspaceBytes * forecast.matrix_entries;
  return bytes <= kFactorShare * available_bytes ? LinearSolver::cholesky : LinearSolver::iterative;
}

double available_memory_bytes() {
  double available = 4.0 * (1ULL << 30U);
  std::ifstream in("/proc/meminfo");
  for (std::string key, line; in >> key; std::getline(in, line))
    if (double kib = 0; key == "MemAvailable:" && in >> kib) {
      available = 1024 * kib;
      break;
    }
  const auto limit = number_in("/sys/fs/cgroup/memory.max");
  const auto used = number_in("/sys/fs/cgroup/memory.current");
  if (limit && used) available = std::min(available, std::max(0.0, *limit - *used));
  rlimit space{};
  std::ifstream pages("/proc/self/statm");
  if (double used_pages = 0;
      getrlimit(RLIMIT_AS, &space) == 0 && space.rlim_cur != RLIM_INFINITY && pages >> used_pages)
    available = std::min(
        available, std::max(0.0, static_cast<double>(space.rlim_cur) -
                                     used_pages * static_cast<double>(sysconf(_SC_PAGESIZE))));
  return available;
}

}  // namespace hyperex::fem
