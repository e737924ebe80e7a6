// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

namespace hyperex {

/// SHA-256 (FIPS 180-4) of what is added, in any pieces. Nettle's.
class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(Sha256&& other) noexcept;
  Sha256& operator=(Sha256&& other) noexcept;
  void add(const void* bytes, std::size_t size);
  /// A text with its length, so that "ab", "c" and "a", "bc" have different hashes.
  void add_text(std::string_view text);
  /// A file's bytes and their number; false where it cannot be read to its end.
  bool add_file(const std::filesystem::path& file);
  /// 64 hexadecimal digits. Nothing may be added afterwards.
  std::string hex();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hyperex
