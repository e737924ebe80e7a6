// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace hyperex::bench {

/// The highest rate (bytes/s) at which `threads` threads together read `bytes` repeatedly from
/// beginning to end, each its own part. Data larger than the caches are read from memory. This is
/// the reading half of STREAM (McCalpin, 1995), with the widest vectors of the processor.
double read_rate(std::size_t bytes, int threads);

/// Processor, caches, memory, and read rates from memory and from the last-level cache with one and
/// two threads.
nlohmann::ordered_json describe_machine();

/// Cores that this process may use.
int cores();

/// This process's peak resident memory since the last reset (bytes; only on Linux).
double peak_memory();
void reset_peak_memory();

/// Writes atomically, or to the standard output where `file` is "-".
void write_json(const nlohmann::ordered_json& json, const std::string& file);

}  // namespace hyperex::bench
