// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/study/sha256.hpp"

#include <nettle/sha2.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <vector>

#include "hyperex/core/error.hpp"

namespace hyperex::study {

struct Sha256::State {
  sha256_ctx context;
};

Sha256::Sha256() : state_(std::make_unique<State>()) {
  sha256_init(&state_->context);
}
Sha256::~Sha256() = default;

void Sha256::add(std::string_view bytes) {
  sha256_update(&state_->context, bytes.size(),
                reinterpret_cast<const std::uint8_t*>(bytes.data()));
}

std::string Sha256::hex() {
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(&state_->context, digest.size(), digest.data());
  constexpr const char* digits = "0123456789abcdef";
  std::string text;
  for (const std::uint8_t byte : digest) {
    text += digits[byte >> 4];
    text += digits[byte & 15];
  }
  return text;
}

std::string sha256_of(std::string_view bytes) {
  Sha256 hash;
  hash.add(bytes);
  return hash.hex();
}

std::string sha256_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw InputError(file, "cannot be read");
  Sha256 hash;
  std::vector<char> part(1 << 20);  // recordings are large
  while (stream.read(part.data(), std::streamsize(part.size())), stream.gcount() > 0)
    hash.add({part.data(), std::size_t(stream.gcount())});
  if (stream.bad()) throw InputError(file, "cannot be read to its end");
  return hash.hex();
}

}  // namespace hyperex::study
