// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/metrics/baseline.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/anatomy/lips.hpp"
#include "hyperex/core/error.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/rbf.hpp"
#include "hyperex/simulate/load/carried_shapes.hpp"

namespace hyperex::metrics {
namespace {

std::vector<int> run(int first, int last) {
  std::vector<int> numbers;
  for (int k = first; k <= last; ++k) numbers.push_back(k);
  return numbers;
}

struct Carried {
  Points at, displacement;  // |points| x 3
};

Eigen::VectorXd flattened(const Points& rows) {
  return Eigen::Map<const Eigen::VectorXd>(rows.data(), rows.size());
}
Points rows_of_three(const Eigen::VectorXd& values) {
  return Eigen::Map<const Points>(values.data(), values.size() / 3, 3);
}

Carried landmarks_carried(const TriMesh& rest, const Points& truth, const io::Landmarks& landmarks,
                          const std::vector<int>& points, const std::vector<int>& moving) {
  Carried carried{Points(points.size(), 3), Points::Zero(points.size(), 3)};
  std::string missing;
  const SurfaceTree tree(rest);
  for (size_t i = 0; i < points.size(); ++i) {
    const std::string name = face::ibug(points[i]);
    const auto found = landmarks.find(name);
    if (found == landmarks.end()) {
      missing += (missing.empty() ? "" : ", ") + name;
      continue;
    }
    carried.at.row(i) = found->second.transpose();
    if (std::find(moving.begin(), moving.end(), points[i]) == moving.end()) continue;
    const ClosestPoint on_skin = tree.query(found->second);
    for (int k = 0; k < 3; ++k) {
      const int vertex = rest.triangles(on_skin.triangle, k);
      carried.displacement.row(i) +=
          on_skin.weights[k] * (truth.row(vertex) - rest.points.row(vertex));
    }
  }
  if (!missing.empty())
    throw InputError("landmarks", "the baseline needs points that are not there: " + missing);
  return carried;
}

/// Moves `rest` in two steps. Blend shapes are fitted to the displacements of the first `moving`
/// points. A warp then adds the displacement that they leave at all points. `sigma_m`: standard
/// deviation of the shapes' error at a point.
Points moved_by_shapes(const TriMesh& rest, const std::vector<double>& upper_margin,
                       const io::Landmarks& landmarks, const std::vector<int>& ibug,
                       std::size_t moving, double sigma_m, Carried carried) {
  constexpr Eigen::Index most = 20000;  // vertices at once, which limits the memory
  std::vector<simulate::DrivenPoint> points;
  for (std::size_t i = 0; i < ibug.size(); ++i)
    points.push_back({face::ibug(ibug[i]), carried.at.row(Eigen::Index(i)).transpose()});
  const std::vector<simulate::DrivenPoint> seen(points.begin(),
                                                points.begin() + std::ptrdiff_t(moving));
  const auto shapes_at = [&](Eigen::Index from, Eigen::Index rows, const auto& at) {
    const auto margin = upper_margin.begin() + from;
    return simulate::CarriedShapes(rest.points.middleRows(from, rows), {margin, margin + rows},
                                   landmarks, at, sigma_m);
  };
  const Eigen::VectorXd weights =
      shapes_at(0, 0, seen)
          .weights_for(flattened(carried.displacement.topRows(Eigen::Index(moving))));
  Points moved = rest.points;
  for (Eigen::Index from = 0; from < moved.rows(); from += most) {
    const Eigen::Index rows = std::min(most, moved.rows() - from);
    moved.middleRows(from, rows) += rows_of_three(shapes_at(from, rows, seen).at_nodes() * weights);
  }
  carried.displacement -= rows_of_three(shapes_at(0, 0, points).at_points() * weights);
  return moved + Rbf(carried.at, carried.displacement, {}).at_all(rest.points);
}

Points warped(const TriMesh& rest, const Carried& carried, double smoothing_m = 0) {
  const Rbf rbf(carried.at, carried.displacement, {.smoothing = smoothing_m});
  return rest.points + rbf.at_all(rest.points);
}

}  // namespace

const std::vector<int>& driven_ibug_points() {
  static const std::vector<int> points = {48, 54, 51, 57, 8, 58, 56};
  return points;
}

const std::vector<int>& still_ibug_points() {
  static const std::vector<int> points = [] {
    std::vector<int> all = run(0, 3);
    for (const int k : run(13, 47)) all.push_back(k);
    return all;
  }();
  return points;
}

std::vector<Baseline> baselines(const TriMesh& rest, const Points& truth,
                                const io::Landmarks& landmarks) {
  std::vector<int> seven_and_still = driven_ibug_points();
  seven_and_still.insert(seven_and_still.end(), still_ibug_points().begin(),
                         still_ibug_points().end());
  const Carried seven =
      landmarks_carried(rest, truth, landmarks, seven_and_still, driven_ibug_points());
  const Carried all = landmarks_carried(rest, truth, landmarks, run(0, 67), run(0, 67));
  const std::vector<double> margin = anatomy::upper_lip_margin(rest, landmarks);
  return {{"standing still", "standing_still", rest.points},
          {"warp, 7 points", "warp_7", warped(rest, seven)},
          {"warp, all 68", "warp_68", warped(rest, all)},
          {"the same, smoothed", "warp_68_smoothed", warped(rest, all, 1e-3)},
          {"blend shapes, 7 points", "shapes_7",
           moved_by_shapes(rest, margin, landmarks, seven_and_still, driven_ibug_points().size(),
                           1.5e-3, seven)},
          {"blend shapes, all 68", "shapes_68",
           moved_by_shapes(rest, margin, landmarks, run(0, 67), 68, 3e-3, all)}};
}

}  // namespace hyperex::metrics
