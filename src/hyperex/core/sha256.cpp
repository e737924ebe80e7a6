// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/sha256.hpp"

#include <fmt/format.h>
#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

namespace hyperex {

struct Sha256::State {
  sha256_ctx context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  sha256_init(&state_->context);
}
Sha256::~Sha256() = default;
Sha256::Sha256(Sha256&& other) noexcept = default;
Sha256& Sha256::operator=(Sha256&& other) noexcept = default;

void Sha256::add(const void* bytes, std::size_t size) {
  sha256_update(&state_->context, size, static_cast<const std::uint8_t*>(bytes));
}

void Sha256::add_text(std::string_view text) {
  const std::uint64_t size = text.size();
  add(&size, sizeof size);
  add(text.data(), text.size());
}

bool Sha256::add_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::vector<char> piece(std::size_t(1) << 18);
  std::uint64_t size = 0;
  while (stream) {
    stream.read(piece.data(), std::streamsize(piece.size()));
    add(piece.data(), std::size_t(stream.gcount()));
    size += std::uint64_t(stream.gcount());
  }
  add(&size, sizeof size);
  return stream.eof();
}

std::string Sha256::hex() {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(&state_->context, digest.size(), digest.data());
  std::string digits;
  for (const std::uint8_t byte : digest) digits += fmt::format("{:02x}", byte);
  return digits;
}

}  // namespace hyperex
