// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <cstddef>
#include <map>
#include <string>

#include "hyperex/geometry/types.hpp"

namespace hyperex::visits {

/// The size of a face in one recording relative to another one of the same person.
struct ScaleBetween {
  double ratio = 0;        ///< 1: the same; NaN: not known
  std::size_t common = 0;  ///< points that both measure
};

/// The ratio of the root mean square distances of the common points from their means, of the face
/// at rest: the scale of the similarity between both where their shapes agree. Not known with fewer
/// than four common points, or where those of `first` are less than 1 mm from their mean. `first`,
/// `now`: places by name, m.
ScaleBetween scale_between(const std::map<std::string, Vec3>& first,
                           const std::map<std::string, Vec3>& now);

/// Scales of one person that differ by more are a warning. Points of a headband that is put on
/// again 5 mm elsewhere, each on its own, change the ratio by 1.6 % (standard deviation, six of
/// them and seven of the mouth); a mouth alone that rests differently by 2 mm, by 2.4 %. Errors of
/// units are 154 % or more.
inline constexpr double kScalesDiffer = 0.06;

}  // namespace hyperex::visits
