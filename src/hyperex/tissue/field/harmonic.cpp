// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/harmonic.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "hyperex/core/error.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kRadius_m = 0.006;
constexpr double kNearest_m = 0.05 * kRadius_m;  // keeps k finite: beyond, nothing changes
constexpr double kLeastShare = 1e-3;

struct WeightedEdge {
  double weight = 0, conductivity = 0;
  int triangles = 0;
};

/// Weights of the edges between joined vertices.
std::map<std::pair<int, int>, WeightedEdge> edges_of(const TriMesh& mesh,
                                                     const std::vector<int>& same,
                                                     const Points& points) {
  std::map<std::pair<int, int>, WeightedEdge> edges;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    std::array<Vec3, 3> p;
    std::array<int, 3> v{};
    for (int k = 0; k < 3; ++k) {
      p[k] = mesh.points.row(mesh.triangles(f, k));
      v[k] = same[mesh.triangles(f, k)];
    }
    const double twice_area = (p[1] - p[0]).cross(p[2] - p[0]).norm();
    if (!(twice_area > 0)) continue;
    const Vec3 centre = (p[0] + p[1] + p[2]) / 3;
    const double d = std::max(
        kNearest_m,
        std::sqrt((points.rowwise() - centre.transpose()).rowwise().squaredNorm().minCoeff()));
    const double conductivity = std::max(1.0, kRadius_m * kRadius_m / (d * d));
    for (int k = 0; k < 3; ++k) {
      const int a = v[(k + 1) % 3], b = v[(k + 2) % 3];
      if (a == b) continue;
      const double cotangent = (p[(k + 1) % 3] - p[k]).dot(p[(k + 2) % 3] - p[k]) / twice_area;
      WeightedEdge& edge = edges[std::minmax(a, b)];
      edge.weight += conductivity * cotangent / 2;
      edge.conductivity += conductivity;
      ++edge.triangles;
    }
  }
  for (auto& entry : edges) {
    WeightedEdge& edge = entry.second;
    edge.weight = std::max(edge.weight, kLeastShare * edge.conductivity / edge.triangles);
  }
  return edges;
}

}  // namespace

struct HarmonicField::Impl {
  Points vertices;
  std::vector<int> same;
  std::vector<int> point_of;         // vertex -> the point whose value it takes, or -1
  std::vector<int> unknown;          // vertex -> row of the system, or -1
  std::vector<int> stray;            // joined vertices that no point reaches
  Eigen::SparseMatrix<double> pull;  // unknowns x points
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factor;
  std::array<int, 2> shared{-1, -1};

  void fix(const std::vector<PlaceOnMesh>& at);
  void number(const std::map<std::pair<int, int>, WeightedEdge>& edges);
  void assemble(const std::map<std::pair<int, int>, WeightedEdge>& edges, Eigen::Index points);
};

void HarmonicField::Impl::fix(const std::vector<PlaceOnMesh>& at) {
  point_of.assign(same.size(), -1);
  for (std::size_t i = 0; i < at.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      if (at[i].weight[k] < 1e-9) continue;
      int& owner = point_of[same[at[i].vertex[k]]];
      if (owner >= 0 && owner != int(i) && shared[0] < 0) shared = {owner, int(i)};
      if (owner < 0) owner = int(i);
    }
}

/// Numbers the free vertices that a walk from some point reaches; the others are strays.
void HarmonicField::Impl::number(const std::map<std::pair<int, int>, WeightedEdge>& edges) {
  std::vector<std::vector<int>> around(same.size());
  for (const auto& [ends, edge] : edges) {
    around[ends.first].push_back(ends.second);
    around[ends.second].push_back(ends.first);
  }
  std::vector<int> queue;
  std::vector<char> reached(same.size(), 0);
  for (std::size_t v = 0; v < same.size(); ++v)
    if (point_of[v] >= 0) {
      queue.push_back(int(v));
      reached[v] = 1;
    }
  for (std::size_t next = 0; next < queue.size(); ++next)
    for (const int w : around[queue[next]])
      if (!reached[w]) {
        reached[w] = 1;
        queue.push_back(w);
      }
  unknown.assign(same.size(), -1);
  int count = 0;
  for (std::size_t v = 0; v < same.size(); ++v) {
    if (same[v] != int(v) || point_of[v] >= 0) continue;
    if (reached[v])
      unknown[v] = count++;
    else
      stray.push_back(int(v));
  }
}

void HarmonicField::Impl::assemble(const std::map<std::pair<int, int>, WeightedEdge>& edges,
                                   Eigen::Index points) {
  using Triplet = Eigen::Triplet<double>;
  std::vector<Triplet> inner, outer;
  for (const auto& [ends, edge] : edges)
    for (const auto& [v, w] : {ends, std::pair{ends.second, ends.first}}) {
      if (unknown[v] < 0) continue;
      inner.emplace_back(unknown[v], unknown[v], edge.weight);
      if (unknown[w] >= 0)
        inner.emplace_back(unknown[v], unknown[w], -edge.weight);
      else
        outer.emplace_back(unknown[v], point_of[w], edge.weight);
    }
  const auto count = *std::max_element(unknown.begin(), unknown.end()) + 1;
  pull.resize(count, points);
  pull.setFromTriplets(outer.begin(), outer.end());
  if (count == 0) return;
  Eigen::SparseMatrix<double> matrix(count, count);
  matrix.setFromTriplets(inner.begin(), inner.end());
  factor.compute(matrix);
  if (factor.info() != Eigen::Success)
    throw NumericalError("the harmonic tissue field cannot be solved on this skin");
}

HarmonicField::HarmonicField(const TriMesh& mesh, const std::vector<int>& same,
                             const std::vector<PlaceOnMesh>& at)
    : impl_(std::make_unique<Impl>()) {
  impl_->vertices = mesh.points;
  impl_->same = same;
  Points points(Eigen::Index(at.size()), 3);
  for (std::size_t i = 0; i < at.size(); ++i) {
    points.row(Eigen::Index(i)).setZero();
    for (int k = 0; k < 3; ++k)
      points.row(Eigen::Index(i)) += at[i].weight[k] * mesh.points.row(at[i].vertex[k]);
  }
  const auto edges = edges_of(mesh, same, points);
  impl_->fix(at);
  impl_->number(edges);
  impl_->assemble(edges, points.rows());
}

HarmonicField::~HarmonicField() = default;

std::array<int, 2> HarmonicField::shared_corner() const {
  return impl_->shared;
}

Eigen::VectorXd HarmonicField::solve(const Eigen::VectorXd& values) const {
  const Impl& m = *impl_;
  const double low = values.minCoeff(), high = values.maxCoeff();
  Eigen::VectorXd solved;
  if (m.pull.rows() > 0) solved = m.factor.solve(m.pull * values);
  Eigen::VectorXd out(Eigen::Index(m.same.size()));
  std::vector<int> known;
  for (std::size_t v = 0; v < m.same.size(); ++v) {
    if (m.same[v] != int(v)) continue;
    if (m.point_of[v] >= 0)
      out[Eigen::Index(v)] = values[m.point_of[v]];
    else if (m.unknown[v] >= 0)  // clamped: the solver's rounding alone leaves the interval
      out[Eigen::Index(v)] = std::clamp(solved[m.unknown[v]], low, high);
    else
      continue;
    known.push_back(int(v));
  }
  for (const int v : m.stray) {
    const auto far = [&](int w) { return (m.vertices.row(w) - m.vertices.row(v)).squaredNorm(); };
    out[v] = out[*std::min_element(known.begin(), known.end(),
                                   [&](int a, int b) { return far(a) < far(b); })];
  }
  for (std::size_t v = 0; v < m.same.size(); ++v) out[Eigen::Index(v)] = out[m.same[v]];
  return out;
}

std::vector<int> joined_vertices(const Points& points, const std::vector<double>& upper_margin) {
  std::vector<int> same(points.rows());
  std::iota(same.begin(), same.end(), 0);
  std::map<std::array<double, 3>, std::array<int, 2>> at_place;  // lower, upper
  for (Eigen::Index v = 0; v < points.rows(); ++v) {
    auto& first =
        at_place.try_emplace({points(v, 0), points(v, 1), points(v, 2)}, std::array{-1, -1})
            .first->second[upper_margin[v] > 0];
    if (first < 0)
      first = int(v);
    else
      same[v] = first;
  }
  return same;
}

}  // namespace hyperex::tissue
