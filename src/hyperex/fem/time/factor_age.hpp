// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cmath>

namespace hyperex::fem {

/// A new factor costs as much as this many corrections with the old one.
inline constexpr double kFactorInCorrections = 10;

/// When a new factor pays. An old one serves as long as the mean cost of the parts of steps that
/// were taken with it falls.
class FactorAge {
 public:
  bool rough = true;  ///< the factor is of the projected matrix, or of the state at rest

  /// A new factor was made for a RateRule whose `now` is `rate`.
  void renew(double rate) {
    rate_ = rate;
    parts_ = corrections_ = 0;
  }
  /// The next part gets a new factor.
  void retire() { parts_ = 0; }
  void count_correction() { ++corrections_; }

  bool is_due(double rate) const {
    return rough || parts_ == 0 || parts_afresh_ > 0 || std::abs(rate_ - rate) > kSameRate * rate ||
           last_cost_ * parts_ > kFactorInCorrections + corrections_;
  }

  /// A part has ended that cost as much as `cost` corrections, besides the factor it began with.
  void count_part(bool began_afresh, double cost) {
    ++parts_;
    last_cost_ = cost;
    if (began_afresh) {
      parts_afresh_ = std::max(0, parts_afresh_ - 1);
    } else if (cost > kFactorInCorrections) {
      parts_afresh_ = next_parts_afresh_;
      next_parts_afresh_ = std::min(2 * next_parts_afresh_, kMostPartsAfresh);
    } else {
      next_parts_afresh_ = std::max(1, next_parts_afresh_ / 2);
    }
  }

 private:
  static constexpr int kMostPartsAfresh = 16;
  /// Steps whose backward differences differ by less than this share can do with the same factor.
  static constexpr double kSameRate = 0.01;

  int parts_ = 0, corrections_ = 0;  // with the present factor
  double last_cost_ = 0;             // of the last part, in corrections
  // Where an old factor did not pay, this many parts get their own, and the next time twice as
  // many.
  int parts_afresh_ = 0, next_parts_afresh_ = 1;
  double rate_ = -1;
};

}  // namespace hyperex::fem
