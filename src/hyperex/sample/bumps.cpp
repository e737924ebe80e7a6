// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/sample/bumps.hpp"

#include <cmath>

namespace hyperex::sample {

Points displacement(const std::vector<Bump>& bumps, const io::Landmarks& landmarks,
                    const Points& points) {
  Points sum = Points::Zero(points.rows(), 3);
  for (const Bump& bump : bumps) {
    const Vec3 centre = landmarks.at(bump.landmark), shift = 1e-3 * bump.shift_mm;
    const double reach = 1e-3 * bump.reach_mm;
    for (Eigen::Index v = 0; v < points.rows(); ++v) {
      const double squared = (points.row(v).transpose() - centre).squaredNorm();
      sum.row(v) += std::exp(-squared / (2 * reach * reach)) * shift.transpose();
    }
  }
  return sum;
}

}  // namespace hyperex::sample
