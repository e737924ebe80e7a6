// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/drive/skin_places.hpp"

#include "hyperex/anatomy/lips.hpp"

namespace hyperex::simulate {

namespace {
/// Below this a weight is the rounding of a place on an edge or at a corner.
constexpr double kLeastWeight = 1e-6;
}  // namespace

std::vector<int> lip_sides(const std::vector<double>& upper_margin) {
  constexpr double sure_m = 0.002;
  std::vector<int> sides;
  for (const double m : upper_margin) sides.push_back(m > sure_m ? 1 : m < -sure_m ? -1 : 0);
  return sides;
}

std::vector<Match> skin_places(const tissue::TissueMesh& mesh,
                               const std::vector<std::string>& names, const Points& places) {
  std::vector<int> side;
  for (const std::string& name : names) side.push_back(anatomy::lip_of(name));
  return match(places, mesh.skin, side, lip_sides(mesh.skin_upper_margin));
}

CarrierMatrix carriers(const tissue::TissueMesh& mesh, const std::vector<Match>& places) {
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t i = 0; i < places.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const tissue::Anchor& anchor = mesh.anchors[places[i].point[k]];
      for (int a = 0; a < 3; ++a)
        if (const double weight = places[i].weight[k] * anchor.weight[a]; weight > kLeastWeight)
          entries.emplace_back(static_cast<int>(i), anchor.node[a], weight);
    }
  CarrierMatrix matrix(static_cast<Eigen::Index>(places.size()), mesh.volume.surface_nodes());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Eigen::MatrixXd at_places(const CarrierMatrix& weights, const Eigen::MatrixXd& nodal) {
  Eigen::MatrixXd out(3 * weights.rows(), nodal.cols());
  for (Eigen::Index c = 0; c < nodal.cols(); ++c) {
    const Points moved = weights * Eigen::Map<const Points>(nodal.col(c).data(), weights.cols(), 3);
    out.col(c) = Eigen::Map<const Eigen::VectorXd>(moved.data(), moved.size());
  }
  return out;
}

}  // namespace hyperex::simulate
