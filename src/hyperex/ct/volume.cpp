// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/volume.hpp"

#include <cmath>
#include <limits>

namespace hyperex::ct {

namespace {
constexpr double kLeastStep_m = 1e-5, kMostStep_m = 0.1, kMostReach_m = 5, kMostPlace_m = 100;
constexpr double kLeastSolid = 0.1;  // of the voxel that steps at right angles would make
}  // namespace

Eigen::Matrix3d face_from_patient() {
  Eigen::Matrix3d rows;
  rows << 1, 0, 0, 0, 0, 1, 0, -1, 0;
  return rows;
}

double Volume::voxel_m3() const {
  return std::abs(step_m.determinant());
}

double Volume::sample(const Vec3& place_m) const {
  const Vec3 at_index = index_of(place_m);
  std::array<int, 3> low{};
  Vec3 share;
  for (int a = 0; a < 3; ++a) {
    // Rounding must not leave out the last plane.
    if (!(at_index[a] >= -1e-9) || !(at_index[a] <= size[std::size_t(a)] - 1 + 1e-9))
      return std::numeric_limits<double>::quiet_NaN();
    low[std::size_t(a)] =
        std::clamp(int(std::floor(at_index[a])), 0, std::max(0, size[std::size_t(a)] - 2));
    share[a] = at_index[a] - low[std::size_t(a)];
  }
  double sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    double weight = 1;
    std::array<int, 3> index = low;
    for (int a = 0; a < 3; ++a) {
      const bool far = ((corner >> a) & 1) != 0;
      weight *= far ? share[a] : 1 - share[a];
      if (far)
        index[std::size_t(a)] = std::min(index[std::size_t(a)] + 1, size[std::size_t(a)] - 1);
    }
    sum += weight * hu[at(index[0], index[1], index[2])];
  }
  return sum;
}

int Volume::upward_axis() const {
  int best = 0;
  Eigen::RowVector3d up = step_m.row(1).cwiseAbs().cwiseQuotient(step_m.colwise().norm());
  up.maxCoeff(&best);
  return best;
}

bool Volume::is_possible() const {
  if (!step_m.allFinite() || !origin_m.allFinite()) return false;
  const Vec3 step = spacing_m(), reach = step.cwiseProduct(Vec3(size[0], size[1], size[2]));
  return step.minCoeff() >= kLeastStep_m && step.maxCoeff() <= kMostStep_m &&
         reach.maxCoeff() <= kMostReach_m && origin_m.norm() <= kMostPlace_m &&
         voxel_m3() >= kLeastSolid * step.prod();
}

}  // namespace hyperex::ct
