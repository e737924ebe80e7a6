// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

namespace hyperex {

/// SHA-256 (FIPS 180-4) of what is added, in any pieces.
class Sha256 {
 public:
  void add(const void* bytes, std::size_t size);
  /// A text with its length: texts one after the other do not run into each other.
  void add_text(std::string_view text);
  /// A file's bytes; false where it cannot be read to its end.
  bool add_file(const std::filesystem::path& file);
  /// 64 hexadecimal digits. Nothing may be added afterwards.
  std::string hex();

 private:
  void block(const std::uint8_t* bytes);

  std::array<std::uint32_t, 8> state_ = {0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                         0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> pending_{};
  std::uint64_t length_ = 0;  // bytes
};

}  // namespace hyperex
