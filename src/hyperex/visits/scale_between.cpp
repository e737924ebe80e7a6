// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/scale_between.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "hyperex/face/same_place.hpp"

namespace hyperex::visits {
namespace {

double rms_from_mean(const std::vector<Vec3>& places) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& place : places) mean += place / double(places.size());
  double squares = 0;
  for (const Vec3& place : places) squares += (place - mean).squaredNorm();
  return std::sqrt(squares / double(places.size()));
}

}  // namespace

ScaleBetween scale_between(const std::map<std::string, Vec3>& first,
                           const std::map<std::string, Vec3>& now) {
  constexpr std::size_t least_points = 4;
  constexpr double least_spread_m = 1e-3;
  std::vector<Vec3> there, here;
  for (const auto& [name, at_first] : first) {
    const auto at = now.find(name);
    if (at == now.end()) continue;
    // A place that has two names counts once.
    if (const std::string place = face::place_name(name);
        place != name && first.contains(place) && now.contains(place))
      continue;
    there.push_back(at_first);
    here.push_back(at->second);
  }
  ScaleBetween out{std::numeric_limits<double>::quiet_NaN(), there.size(), kScalesDiffer};
  if (there.size() < least_points) return out;
  const double spread_m = rms_from_mean(there);
  if (spread_m < least_spread_m) return out;
  out.ratio = rms_from_mean(here) / spread_m;
  out.bound = std::max(kScalesDiffer, kSpreadsDiffer_m / spread_m);
  return out;
}

}  // namespace hyperex::visits
