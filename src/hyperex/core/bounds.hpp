// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <limits>
#include <string>

namespace hyperex {

/// Allowed values of an option, in the unit of its name; both ends are allowed unless it says
/// otherwise. NaN is never allowed.
struct Bounds {
  double least, most;
  bool above_least = false;  ///< `least` itself is refused
  bool or_zero = false;      ///< 0 is allowed besides
  constexpr bool holds(double value) const {
    if (or_zero && value == 0) return true;
    return (above_least ? value > least : value >= least) && value <= most;
  }
  constexpr bool limited() const { return most < std::numeric_limits<double>::infinity(); }
  std::string text() const;  ///< "1 to 30", "above 0 to 1e+06", "0, or 1 to 40"
  /// "a number from 1 to 30", "an integer above 0 to 9"; `what` is "a number" or "an integer".
  std::string expected(const std::string& what = "a number") const;
};

}  // namespace hyperex
