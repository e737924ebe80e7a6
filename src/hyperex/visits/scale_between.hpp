// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <map>
#include <string>

#include "hyperex/geometry/types.hpp"

namespace hyperex::visits {

/// Scales of one person that differ by more are a warning. It is 6 %, or 3 mm of the points' root
/// mean square distance from their mean, whichever is more: 12 % for a mouth alone. By a headband
/// whose six points are each put on again 5 mm elsewhere, and seven points of a mouth that rests
/// differently by 2 mm, the ratio is off by 4.5 % in one of 1,000 draws. By a mouth alone it is off
/// by 8.5 %. Errors of units are 154 % or more.
inline constexpr double kScalesDiffer = 0.06, kSpreadsDiffer_m = 0.003;

/// The size of a face in one recording relative to another one of the same person.
struct ScaleBetween {
  double ratio = 0;        ///< 1: the same; NaN: not known
  std::size_t common = 0;  ///< points that both measure
  double bound = 0;        ///< of |ratio - 1|, by kScalesDiffer and kSpreadsDiffer_m
};

/// The ratio of the root mean square distances of the common points from their means, of the face
/// at rest: the scale of the similarity between both where their shapes agree. Not known with fewer
/// than four common points, or where those of `first` are less than 1 mm from their mean. `first`,
/// `now`: places by name, m.
ScaleBetween scale_between(const std::map<std::string, Vec3>& first,
                           const std::map<std::string, Vec3>& now);

}  // namespace hyperex::visits
