// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/lid_aperture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "hyperex/face/ibug.hpp"

namespace hyperex::simulate {
namespace {

/// A point of the upper lid and the one below it on the lower lid: rows of a motion.
struct LidPair {
  int upper, lower;

  Vec3 between(const Points& at) const { return (at.row(upper) - at.row(lower)).transpose(); }
};

/// What the correction adds to both points of a pair: a row per sample, m.
struct Added {
  Points upper, lower;
};

/// Nothing where the pair is left as it is.
std::optional<Added> match_aperture(AlignedMotion& aligned, const motion::Motion& recorded,
                                    const LidPair& pair) {
  constexpr double least_m = 0.002, most_ratio = 2;
  const Vec3 rest = pair.between(aligned.rest), recorded_rest = pair.between(recorded.positions[0]);
  const double ratio = rest.norm() / (recorded_rest.norm() * aligned.scan_from_motion.scale);
  if (rest.norm() < least_m || !(ratio > 1 / most_ratio && ratio < most_ratio)) return {};
  const Vec3 along = rest.normalized(), recorded_along = recorded_rest.normalized();
  const auto samples = Eigen::Index(recorded.positions.size());
  Added added{Points::Zero(samples, 3), Points::Zero(samples, 3)};
  for (std::size_t k = 0; k < recorded.positions.size(); ++k) {
    Points& now = aligned.motion.positions[k];
    const double share = std::max(
        0.0, pair.between(recorded.positions[k]).dot(recorded_along) / recorded_rest.norm());
    const double missing_m = share * rest.norm() - pair.between(now).dot(along);
    const double up_m = std::abs((now.row(pair.upper) - aligned.rest.row(pair.upper)).dot(along));
    const double down_m = std::abs((now.row(pair.lower) - aligned.rest.row(pair.lower)).dot(along));
    if (up_m + down_m == 0 || !std::isfinite(missing_m)) continue;
    const double of_upper = up_m / (up_m + down_m);
    added.upper.row(Eigen::Index(k)) = of_upper * missing_m * along.transpose();
    added.lower.row(Eigen::Index(k)) = -(1 - of_upper) * missing_m * along.transpose();
    now.row(pair.upper) += added.upper.row(Eigen::Index(k));
    now.row(pair.lower) += added.lower.row(Eigen::Index(k));
  }
  return added;
}

/// Moves a point in the middle of a lid by the mean of what its two neighbours were moved by.
void move_between(AlignedMotion& aligned, const std::string& middle, const Points& one,
                  const Points& other) {
  const int row = aligned.motion.index_of(middle);
  if (row < 0) return;
  for (std::size_t k = 0; k < aligned.motion.positions.size(); ++k)
    aligned.motion.positions[k].row(row) +=
        (one.row(Eigen::Index(k)) + other.row(Eigen::Index(k))) / 2;
}

}  // namespace

void match_lid_apertures(AlignedMotion& aligned, const motion::Motion& recorded) {
  struct Eye {
    const char* side;
    std::array<std::array<int, 2>, 2> pairs;
  };
  constexpr std::array<Eye, 2> eyes = {
      {{"_R", {{{37, 41}, {38, 40}}}}, {"_L", {{{43, 47}, {44, 46}}}}}};
  for (const Eye& eye : eyes) {
    std::vector<Added> added;
    for (const auto& [upper, lower] : eye.pairs) {
      const LidPair pair{recorded.index_of(face::ibug(upper)),
                         recorded.index_of(face::ibug(lower))};
      if (pair.upper < 0 || pair.lower < 0) continue;
      if (auto one = match_aperture(aligned, recorded, pair)) added.push_back(std::move(*one));
    }
    if (added.size() < 2) continue;
    const std::string side = eye.side;
    move_between(aligned, "palpebrale_superius" + side, added[0].upper, added[1].upper);
    move_between(aligned, "palpebrale_inferius" + side, added[0].lower, added[1].lower);
  }
}

}  // namespace hyperex::simulate
