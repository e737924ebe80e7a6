// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace hyperex {

/// A length as it is printed, with one decimal (mm).
inline double printed_mm(double mm) {
  return std::round(10 * mm) / 10;
}

/// A change from one length to another (mm): the difference of both as they are printed, so that
/// the three figures agree beside each other. 0 where it is below half of the last digit. The pages
/// follow the same rule (web/src/replay/corners.ts).
inline double printed_change_mm(double from_mm, double to_mm) {
  return std::abs(to_mm - from_mm) < 0.05 ? 0 : printed_mm(to_mm) - printed_mm(from_mm);
}

/// Two lengths in words, without unit.
struct HeldAgainst {
  std::string own, limit;
  int digits = 1;  ///< decimals of both
};

/// A length and the limit that it is held against (mm), with as many decimals (1 to 3) as keep the
/// comparison true as it is printed: "0.47" and "0.41", not "0.4" and "0.4". `shown_mm` is what is
/// printed with one decimal, as the difference of two rounded figures; `exact_mm` with more. Signs
/// are dropped; a limit above 0 does not print as 0 if three decimals suffice. The pages follow the
/// same rule (web/src/replay/corners.ts).
inline HeldAgainst held_against(double shown_mm, double exact_mm, double limit_mm) {
  const auto printed = [](double mm, int digits) {
    return fmt::format("{:.{}f}", std::abs(mm), digits);
  };
  const auto number = [](const std::string& text) { return std::strtod(text.c_str(), nullptr); };
  const bool less = std::abs(exact_mm) < limit_mm;
  HeldAgainst words;
  for (words.digits = 1; words.digits <= 3; ++words.digits) {
    words.own = printed(words.digits == 1 ? shown_mm : exact_mm, words.digits);
    words.limit = printed(limit_mm, words.digits);
    const double own = number(words.own), limit = number(words.limit);
    if ((less ? own < limit : own > limit) && (limit > 0 || limit_mm == 0)) return words;
  }
  words.digits = 3;
  return words;
}

}  // namespace hyperex
