// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/visits/expression_peak.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "hyperex/metrics/nan.hpp"

namespace hyperex::visits {
namespace {

using metrics::kNan;

double distance(const Points& a, const Points& b, Eigen::Index i, Eigen::Index k) {
  if (a.rows() == 0 || b.rows() == 0) return kNan;
  return (a.row(i) - b.row(k)).norm();
}

/// The mean of those that are measured.
double mean_measured(double right, double left) {
  if (std::isnan(right)) return left;
  return std::isnan(left) ? right : (right + left) / 2;
}

double moved(const ByFacePoint<Points>& tracks, FacePoint right, Eigen::Index k) {
  const auto side = [&](Side s) {
    const Points& track = at(tracks, of_side(right, s));
    return distance(track, track, k, 0);
  };
  return mean_measured(side(Side::right), side(Side::left));
}

double closed(const ByFacePoint<Points>& tracks, Eigen::Index k) {
  const auto side = [&](Side s) {
    const Points& upper = at(tracks, of_side(FacePoint::upper_lid_R, s));
    const Points& lower = at(tracks, of_side(FacePoint::lower_lid_R, s));
    return distance(upper, lower, 0, 0) - distance(upper, lower, k, k);
  };
  return mean_measured(side(Side::right), side(Side::left));
}

}  // namespace

const std::vector<Expression>& expressions() {
  using enum Expression::Movement;
  static const std::vector<Expression> all = {{"smile", corners},    {"show teeth", corners},
                                              {"pucker", corners},   {"mouth open", lips},
                                              {"brow raise", brows}, {"eye closure", lids}};
  return all;
}

std::optional<Expression> expression_named(const std::string& name) {
  const auto found = std::ranges::find(expressions(), name, &Expression::name);
  if (found == expressions().end()) return std::nullopt;
  return *found;
}

std::string moved_part(Expression::Movement movement) {
  using enum Expression::Movement;
  if (movement == lips) return "lips";
  if (movement == brows) return "brows";
  return movement == lids ? "eyelids" : "corners of the mouth";
}

std::vector<double> movement_of(Expression::Movement movement, const ByFacePoint<Points>& tracks) {
  Eigen::Index count = 0;
  for (const Points& track : tracks) count = std::max(count, track.rows());
  std::vector<double> out;
  for (Eigen::Index k = 0; k < count; ++k) {
    using enum Expression::Movement;
    if (movement == corners)
      out.push_back(moved(tracks, FacePoint::corner_R, k));
    else if (movement == brows)
      out.push_back(moved(tracks, FacePoint::brow_R, k));
    else if (movement == lids)
      out.push_back(closed(tracks, k));
    else
      out.push_back(distance(at(tracks, FacePoint::inner_upper_lip),
                             at(tracks, FacePoint::inner_lower_lip), k, k));
  }
  return out;
}

}  // namespace hyperex::visits
