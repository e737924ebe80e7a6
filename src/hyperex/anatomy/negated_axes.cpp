// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/negated_axes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/geometry/transform.hpp"

namespace hyperex::anatomy {
namespace {

// Below this the face fits the scan as it is.
constexpr double kWell_m = 0.002;
constexpr double kShare = 0.5;

double distance(const SurfaceTree& scan, const Vec3& p) {
  return std::sqrt(scan.query(p).squared_distance);
}

/// Median distance from the canonical face, laid on `given`, to the scan. The median, as a scan may
/// end at the chin or the brows.
double askew_m(const Points& canonical, const Points& given, const SurfaceTree& scan) {
  const Points laid = fit_similarity(canonical, given).apply(canonical_face().mesh.points);
  std::vector<double> far;
  for (Eigen::Index v = 0; v < laid.rows(); ++v) far.push_back(distance(scan, laid.row(v)));
  const auto middle = far.begin() + std::ptrdiff_t(far.size() / 2);
  std::nth_element(far.begin(), middle, far.end());
  return *middle;
}

double greatest_offset_m(const Points& given, const SurfaceTree& scan) {
  double greatest = 0;
  for (Eigen::Index i = 0; i < given.rows(); ++i)
    greatest = std::max(greatest, distance(scan, given.row(i)));
  return greatest;
}

std::string sentence(int negated) {
  std::string axes;
  int left = 0;
  for (int k = 0; k < 3; ++k) left += negated >> k & 1;
  const bool mirrored = left % 2 == 1;
  for (int k = 0; k < 3; ++k) {
    if (!(negated >> k & 1)) continue;
    axes += "xyz"[k];
    if (--left > 0) axes += left == 1 ? " and " : ", ";
  }
  const std::string cause =
      mirrored ? "they are mirrored: left and right are exchanged (L and R are the subject's own "
                 "sides), or an axis points the other way"
      : negated == 3 ? "are they in RAS axes and the scan in LPS, or the other way round?"
                     : "are they in the scan's axes?";
  return fmt::format("these landmarks fit the scan only with {} negated: {}", axes, cause);
}

}  // namespace

std::optional<std::string> negated_axes_problem(const Points& canonical, const Points& given,
                                                const SurfaceTree& scan, double largest_offset_m) {
  const double now = askew_m(canonical, given, scan);
  if (now < kWell_m && greatest_offset_m(given, scan) <= largest_offset_m) return {};
  double best = kShare * now;
  int found = 0;
  for (int negated = 1; negated < 8; ++negated) {
    const Eigen::RowVector3d sign(negated & 1 ? -1 : 1, negated & 2 ? -1 : 1, negated & 4 ? -1 : 1);
    const Points turned = given.array().rowwise() * sign.array();
    if (greatest_offset_m(turned, scan) > largest_offset_m) continue;
    if (const double askew = askew_m(canonical, turned, scan); askew < best) {
      best = askew;
      found = negated;
    }
  }
  if (found == 0) return {};
  return sentence(found);
}

}  // namespace hyperex::anatomy
