// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/rim.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kWhole_m = 0.002, kNone_m = 0.005;  // walk to the rim: the field alone; no field
constexpr double kOverhang_m = 0.001;  // from a closest point on a border: the field alone
constexpr double kNearRim_m =
    0.006;  // of a hole's border: a farther border of the skin is no rim of it
constexpr double kWidth_m = 0.008;  // of the weights, exp(-(walk / width)^2)
constexpr double kReach_m = 0.016;  // nodes farther are not looked at
constexpr double kRidge = 0.05;     // against gradients that the nodes hardly show
constexpr std::size_t kLeastNodes = 6;
constexpr double kLeastWeight =
    1e-6;  // below, an anchor lies on the edge, or at the corner, beside

using Edge = std::pair<int, int>;
Edge edge(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

/// The borders of the holes: their edges, and a flag per node.
struct Borders {
  std::set<Edge> edges;
  std::vector<char> node;
};

Borders borders_of(const TriMesh& outer, const std::vector<char>& on_border) {
  Borders all;
  all.node.assign(std::size_t(outer.points.rows()), 0);
  for (const auto& loop : boundary_loops(outer.triangles)) {
    if (std::any_of(loop.begin(), loop.end(), [&](int v) { return on_border[std::size_t(v)]; }))
      continue;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      all.edges.insert(edge(loop[i], loop[(i + 1) % loop.size()]));
      all.node[std::size_t(loop[i])] = 1;
    }
  }
  return all;
}

/// The nodes that carry the anchor, at most three.
std::vector<std::pair<int, double>> carried_by(const Anchor& anchor) {
  std::vector<std::pair<int, double>> nodes;
  for (int k = 0; k < 3; ++k)
    if (anchor.weight[k] > kLeastWeight)
      nodes.emplace_back(anchor.node[std::size_t(k)], anchor.weight[k]);
  return nodes;
}

bool on_rim(const std::vector<std::pair<int, double>>& nodes, const Borders& borders) {
  if (nodes.size() == 1) return borders.node[std::size_t(nodes[0].first)] != 0;
  return nodes.size() == 2 && borders.edges.count(edge(nodes[0].first, nodes[1].first)) > 0;
}

/// For each outer node, the vertex of the skin to whose motion it contributes most, or -1.
std::vector<int> most_carried(const std::vector<Anchor>& anchors, Eigen::Index nodes) {
  std::vector<int> vertex(std::size_t(nodes), -1);
  std::vector<double> most(std::size_t(nodes), 0);
  for (std::size_t v = 0; v < anchors.size(); ++v)
    for (int k = 0; k < 3; ++k) {
      const auto node = std::size_t(anchors[v].node[std::size_t(k)]);
      if (anchors[v].weight[k] <= most[node]) continue;
      most[node] = anchors[v].weight[k];
      vertex[node] = int(v);
    }
  return vertex;
}

/// Outer nodes with the length of the walk to each, in rising order.
using NodeWalks = std::vector<std::pair<int, double>>;

/// Weights of the nodes in the value at `place` of the fitted affine field.
Eigen::VectorXd fitted(const Points& outer, const Vec3& place, const NodeWalks& walk_to) {
  const auto count = Eigen::Index(walk_to.size());
  Eigen::MatrixX4d basis(count, 4);
  Eigen::VectorXd trust(count);
  Eigen::Index row = 0;
  for (const auto& [node, walk] : walk_to) {
    const Vec3 off = (outer.row(node).transpose() - place) / kWidth_m;
    basis.row(row) << 1, off.transpose();
    trust[row++] = std::exp(-std::pow(walk / kWidth_m, 2));
  }
  Eigen::Matrix4d normal = basis.transpose() * trust.asDiagonal() * basis;
  normal.diagonal().tail<3>().array() += kRidge * trust.sum();
  const Eigen::Vector4d value = normal.ldlt().solve(Eigen::Vector4d::UnitX());
  return trust.cwiseProduct(basis * value);
}

/// The skin's own vertices around the holes of the simulated surface.
std::vector<int> rims_of(const TriMesh& skin, const TriMesh& outer, const Borders& borders) {
  std::vector<int> rims;
  for (const auto& loop : boundary_loops(skin.triangles))
    for (const int v : loop) {
      const auto near = [&](Eigen::Index node) {
        return borders.node[std::size_t(node)] &&
               (outer.points.row(node) - skin.points.row(v)).norm() < kNearRim_m;
      };
      Eigen::Index node = 0;
      while (node < outer.points.rows() && !near(node)) ++node;
      if (node < outer.points.rows()) rims.push_back(v);
    }
  return rims;
}

using Carried = std::vector<std::pair<int, double>>;

RimVertex mixed(int vertex, double share, const NodeWalks& walk_to, const Eigen::VectorXd& fit,
                const Carried& carried) {
  RimVertex one{vertex, {}, {}};
  Eigen::Index row = 0;
  for (const auto& [node, walk] : walk_to) {
    one.node.push_back(node);
    one.weight.push_back(share * fit[row++]);
  }
  if (share < 1)
    for (const auto& [node, weight] : carried) {
      one.node.push_back(node);
      one.weight.push_back((1 - share) * weight);
    }
  return one;
}

/// The share of the field in the motion of each vertex: 0 away from the rims.
std::vector<double> shares_of(const TriMesh& skin, const TriMesh& outer,
                              const std::vector<Anchor>& anchors, const Borders& borders,
                              const std::vector<double>& from_rim) {
  std::vector<double> share(anchors.size());
  for (std::size_t v = 0; v < anchors.size(); ++v) {
    share[v] = smooth_step((kNone_m - from_rim[v]) / (kNone_m - kWhole_m));
    const Carried carried = carried_by(anchors[v]);
    if (!on_rim(carried, borders)) continue;
    Vec3 foot = -skin.points.row(Eigen::Index(v)).transpose();
    for (const auto& [node, weight] : carried) foot += weight * outer.points.row(node).transpose();
    share[v] = std::max(share[v], smooth_step(foot.norm() / kOverhang_m));
  }
  return share;
}

/// For each vertex with a share, the nodes around it. Walks go from the nodes, which are fewer.
std::vector<NodeWalks> walks_of(const EdgePaths& paths, const std::vector<int>& vertex_of,
                                const std::vector<double>& share) {
  std::vector<std::vector<std::pair<int, double>>> from(vertex_of.size());
  std::vector<int> with_share;
  for (std::size_t v = 0; v < share.size(); ++v)
    if (share[v] > 0) with_share.push_back(int(v));
  const std::vector<double> from_share = paths.distances(with_share, kReach_m);
  tbb::parallel_for(std::size_t(0), vertex_of.size(), [&](std::size_t node) {
    const int start = vertex_of[node];
    if (start < 0 || !std::isfinite(from_share[std::size_t(start)])) return;
    const std::vector<double> walk = paths.distances({start}, kReach_m);
    for (const int v : with_share)
      if (std::isfinite(walk[std::size_t(v)])) from[node].emplace_back(v, walk[std::size_t(v)]);
  });
  std::vector<NodeWalks> to(share.size());
  for (std::size_t node = 0; node < from.size(); ++node)
    for (const auto& [v, walk] : from[node]) to[std::size_t(v)].emplace_back(int(node), walk);
  return to;
}

}  // namespace

std::vector<RimVertex> rim_vertices(const TriMesh& skin, const TriMesh& outer,
                                    const std::vector<Anchor>& anchors,
                                    const std::vector<char>& on_border) {
  const Borders borders = borders_of(outer, on_border);
  if (borders.edges.empty()) return {};
  const EdgePaths paths(skin);
  const std::vector<double> share = shares_of(
      skin, outer, anchors, borders, paths.distances(rims_of(skin, outer, borders), kNone_m));
  const std::vector<NodeWalks> walks =
      walks_of(paths, most_carried(anchors, outer.points.rows()), share);
  std::vector<RimVertex> rim;
  for (std::size_t v = 0; v < share.size(); ++v) {
    if (walks[v].size() < kLeastNodes) continue;
    const Vec3 place = skin.points.row(Eigen::Index(v)).transpose();
    rim.push_back(mixed(int(v), share[v], walks[v], fitted(outer.points, place, walks[v]),
                        carried_by(anchors[v])));
  }
  return rim;
}

}  // namespace hyperex::tissue
