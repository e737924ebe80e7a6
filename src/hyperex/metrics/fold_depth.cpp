// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/fold_depth.hpp"

#include "hyperex/metrics/nan.hpp"

namespace hyperex::metrics {
namespace {

constexpr std::array kShares = {0.3, 0.5, 0.7};
/// A shallower groove has no place.
constexpr double kLeastDepth_mm = 0.5;

}  // namespace

std::array<FoldCut, 3> fold_cuts(const TriMesh& skin, const io::Landmarks& landmarks, bool left) {
  const anatomy::FoldProfile profile(skin, landmarks, left);
  std::array<FoldCut, 3> out;
  for (std::size_t i = 0; i < kShares.size(); ++i) {
    const auto groove = profile.groove(kShares[i]);
    out[i] = groove ? FoldCut{groove->depth_mm,
                              groove->depth_mm >= kLeastDepth_mm ? groove->place_mm : kNan}
                    : FoldCut{kNan, kNan};
  }
  return out;
}

}  // namespace hyperex::metrics
