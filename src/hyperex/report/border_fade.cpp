// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/report/border_fade.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::report {

using Eigen::Index;

Eigen::VectorXf border_fade(const TriMesh& skin) {
  constexpr double width_m = 0.012;
  Eigen::VectorXf fade = Eigen::VectorXf::Ones(skin.points.rows());
  const std::vector<std::vector<int>> loops = boundary_loops(skin.triangles);
  if (loops.empty()) return fade;
  const auto& border = *std::ranges::max_element(
      loops, {}, [&](const std::vector<int>& loop) { return loop_length(loop, skin.points); });
  const Points at = skin.points(border, Eigen::all);
  for (Index v = 0; v < fade.size(); ++v) {
    const double nearest_m =
        std::sqrt((at.rowwise() - skin.points.row(v)).rowwise().squaredNorm().minCoeff());
    fade[v] = float(smooth_step(nearest_m / width_m));
  }
  return fade;
}

}  // namespace hyperex::report
