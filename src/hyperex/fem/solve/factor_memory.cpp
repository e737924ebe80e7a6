// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/fem/solve/factor_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <string_view>

#include "hyperex/core/error.hpp"

namespace hyperex::fem {
namespace {

constexpr double kGib = 1ULL << 30U;

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

double factor_bytes(const FactorForecast& forecast) {
  return kStoredShare * forecast.entries * sizeof(double) * (1 + kStackShare) +
         kWorkspaceBytes * forecast.matrix_entries;
}

void check_factor_fits(const FactorForecast& forecast, double available_bytes,
                       const std::string& purpose) {
  if (const double stored = kStoredShare * forecast.entries; stored > kMostFactorEntries)
    throw NumericalError(
        fmt::format("{}: the factor of the matrix would have {:.3g} entries, and at most {:.3g} "
                    "are possible; a coarser mesh has fewer",
                    purpose, stored, kMostFactorEntries));
  if (const double bytes = factor_bytes(forecast); bytes > kFactorShare * available_bytes)
    throw NumericalError(fmt::format(
        "{}: the factor of the matrix takes {:.1f} GiB of memory and {:.1f} GiB are available; a "
        "coarser mesh takes less",
        purpose, bytes / kGib, available_bytes / kGib));
}

double available_memory_bytes() {
  const auto free_kib = value_of("/proc/meminfo", "MemAvailable:");
  double available = free_kib ? 1024 * *free_kib : 4 * kGib;
  for (const auto& granted : {group_memory_bytes(), address_space_bytes()})
    if (granted) available = std::min(available, *granted);
  return available;
}

}  // namespace hyperex::fem
