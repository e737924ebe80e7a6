// SPDX-License-Identifier: GPL-3.0-or-later
#include "support/machine.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <barrier>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <new>
#include <thread>
#include <vector>

#include "hyperex/core/files.hpp"
#include "support/timing.hpp"

namespace hyperex::bench {
namespace {

constexpr int kLanes = 64;  // independent sums: enough to hide the adder's latency

/// Several independent sums, so that the compiler may use vectors without reordering a sum.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
__attribute__((target_clones("avx512f", "avx2", "default"), optimize("O3")))
#endif
double
sum_of(const double* x, std::size_t n) {
  double sum[kLanes] = {};
  for (std::size_t i = 0; i + kLanes <= n; i += kLanes)
    for (int k = 0; k < kLanes; ++k) sum[k] += x[i + k];
  double all = 0;
  for (const double s : sum) all += s;
  return all;
}

std::string first_line(const std::string& file) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  return line;
}

/// The value behind "key   : value" in a file of /proc.
std::string value_of(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    if (line.rfind(key, 0) == 0) {
      const auto at = line.find_first_not_of(" \t:", key.size());
      return at == std::string::npos ? "" : line.substr(at);
    }
  return "";
}

/// "32768K" in bytes.
double bytes_of(const std::string& text) {
  if (text.empty()) return 0;
  const double number = std::strtod(text.c_str(), nullptr);
  return number * (text.back() == 'K' ? 1024.0 : text.back() == 'M' ? 1048576.0 : 1.0);
}

}  // namespace

double read_rate(std::size_t bytes, int threads) {
  const std::size_t part = bytes / sizeof(double) / static_cast<std::size_t>(threads);
  std::vector<std::vector<double>> data(static_cast<std::size_t>(threads));
  std::vector<double> results(data.size());
  const int passes = static_cast<int>(std::max<std::size_t>(1, (std::size_t{64} << 20) / bytes));
  double best = 0;
  std::barrier all_ready(threads);
  Stopwatch watch;
  const auto work = [&](std::size_t t) {
    data[t].assign(part, 1.0);  // written by the thread that reads it
    for (int trial = 0; trial < 12; ++trial) {
      all_ready.arrive_and_wait();
      if (t == 0) watch.lap();
      for (int p = 0; p < passes; ++p) results[t] += sum_of(data[t].data(), part);
      all_ready.arrive_and_wait();
      if (t == 0) {
        const double read = static_cast<double>(part * sizeof(double)) * threads * passes;
        best = std::max(best, read / watch.lap());
      }
    }
  };
  std::vector<std::thread> others;
  for (int t = 1; t < threads; ++t) others.emplace_back(work, static_cast<std::size_t>(t));
  work(0);
  for (auto& other : others) other.join();
  for (const double r : results)
    if (!(r > 0)) throw std::bad_alloc();  // uses the sums
  return best;
}

int cores() {
  return static_cast<int>(std::max(1L, sysconf(_SC_NPROCESSORS_ONLN)));
}

nlohmann::ordered_json describe_machine() {
  nlohmann::ordered_json m;
  m["processor"] = value_of("/proc/cpuinfo", "model name");
  m["cores"] = cores();
  double last_cache = 0;
  nlohmann::ordered_json caches = nlohmann::ordered_json::array();
  for (int i = 0; i < 8; ++i) {
    const std::string folder = fmt::format("/sys/devices/system/cpu/cpu0/cache/index{}/", i);
    const std::string level = first_line(folder + "level");
    if (level.empty()) break;
    const double bytes = bytes_of(first_line(folder + "size"));
    if (first_line(folder + "type") == "Instruction") continue;
    caches.push_back({{"level", std::stoi(level)}, {"bytes", bytes}});
    last_cache = std::max(last_cache, bytes);
  }
  m["caches"] = caches;
  m["memory_bytes"] = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGESIZE);
  // A third of the last-level cache stays in it; the array that is read from memory is much larger.
  const auto in_cache = static_cast<std::size_t>(last_cache > 0 ? last_cache / 3 : 4e6);
  m["cache_test_bytes"] = in_cache;
  m["memory_test_bytes"] = std::size_t{1} << 30;
  for (int threads = 1; threads <= std::min(2, cores()); ++threads) {
    m["read_memory"].push_back(read_rate(std::size_t{1} << 30, threads));
    m["read_cache"].push_back(read_rate(in_cache, threads));
  }
  m["load_before"] = std::strtod(first_line("/proc/loadavg").c_str(), nullptr);
  return m;
}

double peak_memory() {
  return 1024 * std::strtod(value_of("/proc/self/status", "VmHWM").c_str(), nullptr);
}

void reset_peak_memory() {
  std::ofstream("/proc/self/clear_refs") << "5";
}

void write_json(const nlohmann::ordered_json& json, const std::string& file) {
  if (file == "-") {
    std::cout << json.dump(1) << '\n';
    return;
  }
  write_file_atomically(file, [&](std::ostream& out) { out << json.dump(1) << '\n'; });
}

}  // namespace hyperex::bench
