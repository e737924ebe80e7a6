// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

namespace hyperex {

/// A set of directed edges between vertices: a hash table of fixed size with open addressing. It
/// takes at least 12 bytes per edge; a scan has millions of edges.
class DirectedEdges {
 public:
  explicit DirectedEdges(std::size_t most)
      : slots_(std::bit_ceil(most + most / 2 + 2), kNone), mask_(slots_.size() - 1) {}

  /// Returns false if the edge is already in the set. At most `most` edges may be inserted.
  bool insert(int from, int to) {
    std::uint64_t& slot = slots_[find(key(from, to))];
    const bool fresh = slot == kNone;
    slot = key(from, to);
    return fresh;
  }
  bool contains(int from, int to) const { return slots_[find(key(from, to))] != kNone; }

 private:
  // No valid edge, as vertex numbers are not negative.
  static constexpr std::uint64_t kNone = ~std::uint64_t(0);
  static std::uint64_t key(int from, int to) {
    return (std::uint64_t(std::uint32_t(from)) << 32) | std::uint32_t(to);
  }
  std::size_t find(std::uint64_t key) const {
    std::uint64_t at = key * 0x9e3779b97f4a7c15ULL;  // Fibonacci hashing
    at ^= at >> 32;
    while (slots_[at & mask_] != kNone && slots_[at & mask_] != key) ++at;
    return at & mask_;
  }
  std::vector<std::uint64_t> slots_;
  std::size_t mask_;
};

}  // namespace hyperex
