// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/seams.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <utility>

#include "hyperex/geometry/cotangent_laplacian.hpp"
#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/tissue/mesh/tissue_mesh.hpp"

namespace hyperex::tissue {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

// Differences of weights that are a seam: per metre, per edge of the simulated surface, at most.
constexpr double kPerMetre = 1500, kPerElement = 6, kAnyLength = 1.9;
// Ends of an edge longer than this, in edges of the simulated surface, need share no node.
constexpr double kShort = 0.5;
constexpr double kBesideSeam_m = 0.004;  // walk to a seam: changed
constexpr double kUnsure_m = 0.002;      // walk to a seam: x0 does not count
constexpr double kSmoothing_m = 0.001;
constexpr double kUnsure = 1e-6;   // c there: above 0 for skin that nothing else moves
constexpr double kDropped = 1e-4;  // a node with less is left out

/// The nodes that move each vertex of the skin, with their weights, by node.
using Weights = std::vector<std::vector<std::pair<int, double>>>;

Weights weights_of(const std::vector<Anchor>& anchors, const std::vector<RimVertex>& rim) {
  Weights weights(anchors.size());
  for (std::size_t v = 0; v < anchors.size(); ++v)
    for (int k = 0; k < 3; ++k)
      weights[v].emplace_back(anchors[v].node[std::size_t(k)], anchors[v].weight[k]);
  for (const RimVertex& one : rim) {
    auto& of_vertex = weights[std::size_t(one.vertex)];
    of_vertex.clear();
    for (std::size_t k = 0; k < one.node.size(); ++k)
      of_vertex.emplace_back(one.node[k], one.weight[k]);
  }
  for (auto& of_vertex : weights) std::sort(of_vertex.begin(), of_vertex.end());
  return weights;
}

/// The sum of the differences' magnitudes. A node may occur more than once.
double difference(const Weights::value_type& a, const Weights::value_type& b) {
  double sum = 0;
  std::size_t i = 0, j = 0;
  while (i < a.size() || j < b.size()) {
    const int node = j == b.size()                              ? a[i].first
                     : i == a.size() || b[j].first < a[i].first ? b[j].first
                                                                : a[i].first;
    double off = 0;
    for (; i < a.size() && a[i].first == node; ++i) off += a[i].second;
    for (; j < b.size() && b[j].first == node; ++j) off -= b[j].second;
    sum += std::abs(off);
  }
  return sum;
}

/// Mean edge lengths of the triangles of the simulated surface on which the anchors lie.
std::vector<double> elements_at(const TriMesh& outer, const std::vector<Anchor>& anchors) {
  std::vector<double> element;
  element.reserve(anchors.size());
  for (const Anchor& anchor : anchors) {
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k)
      sum += (outer.points.row(anchor.node[k]) - outer.points.row(anchor.node[(k + 1) % 3])).norm();
    element.push_back(sum / 3);
  }
  return element;
}

/// The ends of the edges that seams cross.
std::vector<int> at_seams(const TriMesh& skin, const TriMesh& outer,
                          const std::vector<Anchor>& anchors, const Weights& weights) {
  const std::vector<double> elements = elements_at(outer, anchors);
  std::vector<char> at(anchors.size(), 0);
  for (const auto t : skin.triangles.rowwise())
    for (int k = 0; k < 3; ++k) {
      const auto a = std::size_t(t[k]), b = std::size_t(t[(k + 1) % 3]);
      const double length =
          (skin.points.row(Eigen::Index(a)) - skin.points.row(Eigen::Index(b))).norm();
      const double element = 0.5 * (elements[a] + elements[b]);
      if ((at[a] && at[b]) || length > kShort * element) continue;
      const double most = std::max(kPerMetre, kPerElement / element) * length;
      if (difference(weights[a], weights[b]) > std::min(most, kAnyLength)) at[a] = at[b] = 1;
    }
  std::vector<int> vertices;
  for (std::size_t v = 0; v < at.size(); ++v)
    if (at[v]) vertices.push_back(int(v));
  return vertices;
}

/// The triangles around the vertices with `flagged` and around their neighbours.
TriMesh around(const TriMesh& skin, std::vector<char> flagged) {
  const std::vector<char> beside = touching(skin.triangles, flagged);
  for (std::size_t f = 0; f < beside.size(); ++f)
    if (beside[f])
      for (const int v : skin.triangles.row(Eigen::Index(f))) flagged[std::size_t(v)] = 1;
  const std::vector<char> take = touching(skin.triangles, flagged);
  TriMesh part{skin.points, Triangles(std::count(take.begin(), take.end(), 1), 3)};
  Eigen::Index row = 0;
  for (std::size_t f = 0; f < take.size(); ++f)
    if (take[f]) part.triangles.row(row++) = skin.triangles.row(Eigen::Index(f));
  return part;
}

/// The connected parts of the vertices with `inside`.
std::vector<std::vector<int>> parts_of(const TriMesh& skin, std::vector<char> inside) {
  const auto neighbours = vertex_neighbours(skin.triangles, skin.points.rows());
  std::vector<std::vector<int>> parts;
  for (std::size_t start = 0; start < inside.size(); ++start) {
    if (!inside[start]) continue;
    std::vector<int> part = {int(start)};
    inside[start] = 0;
    for (std::size_t next = 0; next < part.size(); ++next)
      for (const int v : neighbours[std::size_t(part[next])])
        if (inside[std::size_t(v)]) {
          inside[std::size_t(v)] = 0;
          part.push_back(v);
        }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// A term of a right side: `factor` times the displacement of `vertex` by rim and anchors.
struct Term {
  int row, vertex;
  double factor;
};

/// The displacement of the vertices of one part, which solves the equations of the header. Those
/// outside it stay as they are.
class SmoothPart {
 public:
  /// `counts`: c of the header, times area, per vertex of the skin. `stiffness`: l^4 L A^-1 L.
  SmoothPart(const std::vector<int>& vertices, const Sparse& stiffness,
             const Eigen::VectorXd& counts, const Weights& weights)
      : vertices_(vertices) {
    const auto size = Eigen::Index(vertices.size());
    std::map<int, int> row_of;
    for (std::size_t i = 0; i < vertices.size(); ++i) row_of[vertices[i]] = int(i);
    std::vector<Eigen::Triplet<double>> entries;
    std::vector<Term> right;
    for (int row = 0; row < int(size); ++row) {
      const int v = vertices[std::size_t(row)];
      entries.emplace_back(row, row, counts[v]);
      right.push_back({row, v, counts[v]});
      for (Sparse::InnerIterator it(stiffness, v); it; ++it)
        if (const auto other = row_of.find(int(it.row())); other != row_of.end())
          entries.emplace_back(row, other->second, it.value());
        else
          right.push_back({row, int(it.row()), -it.value()});
    }
    Sparse matrix(size, size);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Sparse> factor(matrix);
    if (factor.info() != Eigen::Success)
      throw std::logic_error("skin near a seam has nothing that moves it");
    solved_ = factor.solve(by_nodes(right, weights, size));
  }

  /// Small weights are left out, and the others scaled to a sum of 1.
  RimVertex vertex(std::size_t row) const {
    RimVertex one{vertices_[row], {}, {}};
    double sum = 0;
    for (std::size_t n = 0; n < nodes_.size(); ++n) {
      const double weight = solved_(Eigen::Index(row), Eigen::Index(n));
      if (std::abs(weight) < kDropped) continue;
      one.node.push_back(nodes_[n]);
      one.weight.push_back(weight);
      sum += weight;
    }
    for (double& weight : one.weight) weight /= sum;
    return one;
  }

 private:
  /// The terms as weights of nodes, one column for each; fills nodes_.
  Eigen::MatrixXd by_nodes(const std::vector<Term>& terms, const Weights& weights,
                           Eigen::Index rows) {
    std::map<int, Eigen::Index> column;
    for (const Term& term : terms)
      for (const auto& [node, weight] : weights[std::size_t(term.vertex)]) column[node] = 0;
    for (auto& [node, place] : column) {
      place = Eigen::Index(nodes_.size());
      nodes_.push_back(node);
    }
    Eigen::MatrixXd out = Eigen::MatrixXd::Zero(rows, Eigen::Index(nodes_.size()));
    for (const Term& term : terms)
      for (const auto& [node, weight] : weights[std::size_t(term.vertex)])
        out(term.row, column.at(node)) += term.factor * weight;
    return out;
  }

  const std::vector<int>& vertices_;
  std::vector<int> nodes_;
  Eigen::MatrixXd solved_;  // |vertices| x |nodes|
};

}  // namespace

std::vector<RimVertex> smooth_seams(const TriMesh& skin, const TriMesh& outer,
                                    const std::vector<Anchor>& anchors,
                                    std::vector<RimVertex> rim) {
  const Weights weights = weights_of(anchors, rim);
  const std::vector<int> seams = at_seams(skin, outer, anchors, weights);
  if (seams.empty()) return rim;
  const std::vector<double> walk = EdgePaths(skin).distances(seams, kBesideSeam_m);
  const Eigen::VectorXd area = node_areas(skin);
  std::vector<char> near(walk.size(), 0);
  Eigen::VectorXd counts(area.size()), inverse_area(area.size());
  for (std::size_t v = 0; v < walk.size(); ++v) {
    const auto row = Eigen::Index(v);
    near[v] = std::isfinite(walk[v]);
    counts[row] = std::max(area[row], kUnsure * area.mean()) * (walk[v] < kUnsure_m ? kUnsure : 1);
    inverse_area[row] = area[row] > 0 ? 1 / area[row] : 0;
  }
  const TriMesh beside = around(skin, near);
  const Sparse laplacian = cotangent_laplacian(beside);
  const Sparse stiffness =
      std::pow(kSmoothing_m, 4) * (laplacian * inverse_area.asDiagonal() * laplacian);
  std::map<int, RimVertex> all;
  for (RimVertex& one : rim) {
    const int vertex = one.vertex;
    all.emplace(vertex, std::move(one));
  }
  for (const std::vector<int>& vertices : parts_of(beside, std::move(near))) {
    const SmoothPart part(vertices, stiffness, counts, weights);
    for (std::size_t i = 0; i < vertices.size(); ++i)
      all.insert_or_assign(vertices[i], part.vertex(i));
  }
  rim.clear();
  for (auto& [vertex, one] : all) rim.push_back(std::move(one));
  return rim;
}

}  // namespace hyperex::tissue
