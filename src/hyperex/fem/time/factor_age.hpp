// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <algorithm>
#include <cmath>

namespace hyperex::fem {

/// The cost of a new factor, in corrections with an existing one.
inline constexpr double kFactorInCorrections = 10;

/// Decides when to compute a new factor. A factor is kept as long as the mean cost per part of a
/// step decreases. This mean includes the cost of the factor.
class FactorAge {
 public:
  bool rough = true;  ///< the factor belongs to the projected matrix or to the rest state

  /// To be called for a new factor, made for a RateRule whose `now` is `rate`.
  void renew(double rate) {
    rate_ = rate;
    parts_ = corrections_ = 0;
  }
  /// Makes the next part compute a new factor.
  void retire() { parts_ = 0; }
  void count_correction() { ++corrections_; }

  bool is_due(double rate) const {
    return rough || parts_ == 0 || parts_afresh_ > 0 || std::abs(rate_ - rate) > kSameRate * rate ||
           last_cost_ * parts_ > kFactorInCorrections + corrections_;
  }

  /// To be called at the end of a part. `cost`: its cost in corrections, without the factor it
  /// began with.
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
  /// A factor can be kept if the rates of the backward differences differ by less than this share.
  static constexpr double kSameRate = 0.01;

  int parts_ = 0, corrections_ = 0;  // with the present factor
  double last_cost_ = 0;             // of the last part, in corrections
  // After an old factor has not paid, this many parts each get a factor of their own. The next time
  // it happens, twice as many do.
  int parts_afresh_ = 0, next_parts_afresh_ = 1;
  double rate_ = -1;
};

}  // namespace hyperex::fem
