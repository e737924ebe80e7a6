// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/face/close_lips.hpp"

#include <algorithm>
#include <cmath>

namespace hyperex::face {
namespace {

constexpr double kLeft_m = 0.2e-3;
constexpr double kLowerShare = 0.7, kLowerReach_m = 0.018, kUpperReach_m = 0.010;
constexpr double kSpread = 0.7;  // 1 sigma of the averaging along the edge, over the distance

using Edge = std::vector<Vec3>;  // with rising x

/// The edge at x, or its nearer end.
Vec3 at(const Edge& edge, double x) {
  std::size_t k = 1;
  while (k + 1 < edge.size() && edge[k].x() < x) ++k;
  const double t = (x - edge[k - 1].x()) / (edge[k].x() - edge[k - 1].x());
  return edge[k - 1] + std::clamp(t, 0.0, 1.0) * (edge[k] - edge[k - 1]);
}

struct Gap {
  Edge upper, lower;

  Gap(const Points& points, const std::vector<int>& contour) {
    const std::size_t n = contour.size();
    for (std::size_t i = 0; i <= n / 2; ++i) {
      upper.push_back(points.row(contour[i]).transpose());
      lower.push_back(points.row(contour[(n - i) % n]).transpose());
    }
  }

  /// From the lower to the upper edge, but for what stays open; zero beside the mouth.
  Vec3 way(double x) const {
    if (x <= lower.front().x() || x >= lower.back().x()) return Vec3::Zero();
    Vec3 across = at(upper, x) - at(lower, x);
    across.x() = 0;
    return across.norm() > kLeft_m ? Vec3((1 - kLeft_m / across.norm()) * across) : Vec3::Zero();
  }

  Vec3 mean_way(double x, double sigma) const {
    constexpr int samples = 15;  // on either side, to three sigma
    constexpr double step = 3.0 / samples;
    Vec3 sum = Vec3::Zero();
    double weights = 0;
    for (int k = -samples; k <= samples; ++k) {
      const double weight = std::exp(-step * step * k * k / 2);
      sum += weight * way(x + step * k * sigma);
      weights += weight;
    }
    return sum / weights;
  }

  Vec3 displacement(const Vec3& p) const {
    const double low = at(lower, p.x()).y(), high = at(upper, p.x()).y();
    const bool below = p.y() < (low + high) / 2;
    const double off = std::max(0.0, below ? low - p.y() : p.y() - high);
    const double falls = off / (below ? kLowerReach_m : kUpperReach_m);
    if (falls > 4) return Vec3::Zero();
    const double share = (below ? kLowerShare : kLowerShare - 1) * std::exp(-falls * falls / 2);
    return share * mean_way(p.x(), kSpread * off);
  }
};

}  // namespace

void close_lips(Points& points, const std::vector<int>& contour) {
  const Gap gap(points, contour);
  for (auto point : points.rowwise()) point += gap.displacement(point.transpose()).transpose();
}

}  // namespace hyperex::face
