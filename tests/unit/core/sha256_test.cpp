// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/core/sha256.hpp"

#include <gtest/gtest.h>

namespace hyperex {
namespace {

std::string hash_of(const std::string& text, std::size_t piece) {
  Sha256 hash;
  for (std::size_t at = 0; at < text.size(); at += piece)
    hash.add(text.data() + at, std::min(piece, text.size() - at));
  return hash.hex();
}

// The examples for FIPS 180-4 (NIST, "Examples with Intermediate Values"), added in pieces of any
// size.
TEST(Sha256, IsWhatTheStandardSays) {
  const std::pair<std::string, const char*> known[] = {
      {"", "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855"},
      {"abc", "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad"},
      {"abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq",
       "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1"},
      {std::string(1000000, 'a'),
       "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0"}};
  for (const auto& [text, digits] : known)
    for (const std::size_t piece : {1000000, 64, 63, 1})
      EXPECT_EQ(hash_of(text, piece), digits) << piece;
}

TEST(Sha256, TextsDoNotRunIntoEachOther) {
  Sha256 one, other;
  one.add_text("ab");
  one.add_text("c");
  other.add_text("a");
  other.add_text("bc");
  EXPECT_NE(one.hex(), other.hex());
}

}  // namespace
}  // namespace hyperex
