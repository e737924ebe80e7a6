// SPDX-License-Identifier: GPL-3.0-or-later
#include "token.hpp"

#include <sys/random.h>

#include <array>
#include <cstddef>

#include "hyperex/core/error.hpp"

namespace hyperex::studio {

std::string new_token() {
  std::array<unsigned char, 16> bytes{};
  if (getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw NumericalError("the system gives no random numbers (getrandom)");
  static constexpr char digits[] = "0123456789abcdef";
  std::string token;
  for (const unsigned char byte : bytes) {
    token += digits[byte >> 4U];
    token += digits[byte & 15U];
  }
  return token;
}

bool same_token(std::string_view given, std::string_view own) {
  unsigned differs = given.size() == own.size() ? 0 : 1;
  for (std::size_t i = 0; i < own.size(); ++i)
    differs |= static_cast<unsigned char>(own[i]) ^
               static_cast<unsigned char>(given.empty() ? 0 : given[i % given.size()]);
  return differs == 0;
}

}  // namespace hyperex::studio
