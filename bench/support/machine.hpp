// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

namespace hyperex::bench {

/// The best rate (bytes/s) at which `threads` threads together read `bytes` from beginning to end,
/// each its own part, again and again: from memory where they are more than the caches hold. The
/// reading half of STREAM (McCalpin, 1995), with the widest vectors that the processor has.
double read_rate(std::size_t bytes, int threads);

/// Processor, caches, memory, and read rates from memory and from the last cache, one and two
/// threads.
nlohmann::ordered_json describe_machine();

/// Cores that this process may use.
int cores();

/// This process's greatest resident memory since the last reset (bytes; Linux alone).
double peak_memory();
void reset_peak_memory();

/// Writes atomically, or to the standard output where `file` is "-".
void write_json(const nlohmann::ordered_json& json, const std::string& file);

}  // namespace hyperex::bench
