// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/lid_aperture.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "hyperex/face/ibug.hpp"

namespace hyperex::simulate {
namespace {

/// A point of the upper lid and the one below it on the lower lid: rows of a motion.
struct LidPair {
  int upper, lower;

  Vec3 between(const Points& at) const { return (at.row(upper) - at.row(lower)).transpose(); }
};

void match_aperture(AlignedMotion& aligned, const motion::Motion& recorded, const LidPair& pair) {
  constexpr double least_m = 0.002, most_ratio = 2;
  const Vec3 rest = pair.between(aligned.rest), recorded_rest = pair.between(recorded.positions[0]);
  const double ratio = rest.norm() / (recorded_rest.norm() * aligned.scan_from_motion.scale);
  if (rest.norm() < least_m || !(ratio > 1 / most_ratio && ratio < most_ratio)) return;
  const Vec3 along = rest.normalized(), recorded_along = recorded_rest.normalized();
  for (std::size_t k = 0; k < recorded.positions.size(); ++k) {
    Points& now = aligned.motion.positions[k];
    const double share = std::max(
        0.0, pair.between(recorded.positions[k]).dot(recorded_along) / recorded_rest.norm());
    const double missing_m = share * rest.norm() - pair.between(now).dot(along);
    const double up_m = std::abs((now.row(pair.upper) - aligned.rest.row(pair.upper)).dot(along));
    const double down_m = std::abs((now.row(pair.lower) - aligned.rest.row(pair.lower)).dot(along));
    if (up_m + down_m == 0 || !std::isfinite(missing_m)) continue;
    const double of_upper = up_m / (up_m + down_m);
    now.row(pair.upper) += of_upper * missing_m * along.transpose();
    now.row(pair.lower) -= (1 - of_upper) * missing_m * along.transpose();
  }
}

}  // namespace

void match_lid_apertures(AlignedMotion& aligned, const motion::Motion& recorded) {
  constexpr std::array<std::array<int, 2>, 4> pairs = {{{37, 41}, {38, 40}, {43, 47}, {44, 46}}};
  for (const auto& [upper, lower] : pairs) {
    const LidPair pair{recorded.index_of(face::ibug(upper)), recorded.index_of(face::ibug(lower))};
    if (pair.upper >= 0 && pair.lower >= 0) match_aperture(aligned, recorded, pair);
  }
}

}  // namespace hyperex::simulate
