// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/rim_places.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/geometry/geodesic.hpp"

namespace hyperex::simulate {
namespace {

constexpr double kWidth_m = 0.004;
constexpr double kReach_m = 3 * kWidth_m;
constexpr double kPlaceRidge = 1e-3;  // where places nearly coincide
constexpr double kLeastShare = 1e-9;

/// The index of each vertex of the skin in mesh.rim, or -1.
std::vector<int> rows_of(const tissue::TissueMesh& mesh) {
  std::vector<int> row(mesh.anchors.size(), -1);
  for (std::size_t r = 0; r < mesh.rim.size(); ++r) row[std::size_t(mesh.rim[r].vertex)] = int(r);
  return row;
}

void add_share(const tissue::RimVertex& from, double share, Eigen::Ref<Eigen::RowVectorXd> to) {
  for (std::size_t k = 0; k < from.node.size(); ++k) to[from.node[k]] += share * from.weight[k];
}

/// The error of the field at a place, as one row with a column per outer node.
Eigen::RowVectorXd off(const tissue::TissueMesh& mesh, const std::vector<int>& row,
                       const Match& place) {
  Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(mesh.volume.surface_nodes());
  for (int k = 0; k < 3; ++k) {
    const auto v = std::size_t(place.point[k]);
    if (row[v] < 0) continue;
    for (int a = 0; a < 3; ++a)
      sum[mesh.anchors[v].node[std::size_t(a)]] += place.weight[k] * mesh.anchors[v].weight[a];
    add_share(mesh.rim[std::size_t(row[v])], -place.weight[k], sum);
  }
  return sum;
}

}  // namespace

std::vector<tissue::RimVertex> rim_through(const tissue::TissueMesh& mesh,
                                           const std::vector<Match>& places) {
  std::vector<tissue::RimVertex> rim = mesh.rim;
  const std::vector<int> row = rows_of(mesh);
  std::vector<Match> on_rim;
  for (const Match& place : places)
    if (std::any_of(place.point.begin(), place.point.end(),
                    [&](int v) { return row[std::size_t(v)] >= 0; }))
      on_rim.push_back(place);
  if (on_rim.empty()) return rim;
  const auto count = Eigen::Index(on_rim.size());
  const EdgePaths paths(mesh.skin);
  Eigen::MatrixXd near(Eigen::Index(rim.size()), count);  // what each place gives each vertex
  Eigen::MatrixXd passed(count, mesh.volume.surface_nodes());
  for (Eigen::Index p = 0; p < count; ++p) {
    const Match& place = on_rim[std::size_t(p)];
    Eigen::Index most = 0;
    place.weight.maxCoeff(&most);
    const std::vector<double> walk = paths.distances({place.point[std::size_t(most)]}, kReach_m);
    for (std::size_t r = 0; r < rim.size(); ++r)
      near(Eigen::Index(r), p) =
          std::exp(-std::pow(walk[std::size_t(rim[r].vertex)] / kWidth_m, 2));
    passed.row(p) = off(mesh, row, place);
  }
  Eigen::MatrixXd given = kPlaceRidge * Eigen::MatrixXd::Identity(count, count);
  for (Eigen::Index p = 0; p < count; ++p)
    for (int k = 0; k < 3; ++k)
      if (const int r = row[std::size_t(on_rim[std::size_t(p)].point[k])]; r >= 0)
        given.row(p) += on_rim[std::size_t(p)].weight[k] * near.row(r);
  const Eigen::MatrixXd added = given.fullPivLu().solve(passed);
  for (std::size_t r = 0; r < rim.size(); ++r) {
    if (near.row(Eigen::Index(r)).maxCoeff() < kLeastShare) continue;
    Eigen::RowVectorXd all = Eigen::RowVectorXd::Zero(added.cols());
    for (Eigen::Index p = 0; p < count; ++p)
      if (const double share = near(Eigen::Index(r), p); share > kLeastShare)
        all += share * added.row(p);
    add_share(rim[r], 1, all);
    rim[r].node.clear();
    rim[r].weight.clear();
    for (Eigen::Index node = 0; node < all.size(); ++node)
      if (std::abs(all[node]) > kLeastShare) {
        rim[r].node.push_back(int(node));
        rim[r].weight.push_back(all[node]);
      }
  }
  return rim;
}

}  // namespace hyperex::simulate
