// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <string>
#include <vector>

#include "hyperex/geometry/types.hpp"
#include "hyperex/io/landmarks.hpp"

namespace hyperex::sample {

/// A smooth displacement about a landmark c of the face at rest:
///   u(x) = shift exp(-|x - c|^2 / (2 reach^2)).
struct Bump {
  std::string landmark;
  Vec3 shift_mm;
  double reach_mm = 10;  ///< > 0
};

/// The sum of all bumps at `points` (metres, the landmarks' frame): one row per point, metres.
/// Throws std::out_of_range where a landmark is missing.
Points displacement(const std::vector<Bump>& bumps, const io::Landmarks& landmarks,
                    const Points& points);

}  // namespace hyperex::sample
