// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/prism_split.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::tissue {
namespace {

constexpr double flat = 0.15;      // radius ratio
constexpr double worth_it = 0.99;  // a fan's badness must fall below this share of what it was
constexpr int sweeps = 20;

class Diagonals {
 public:
  Diagonals(const Triangles& triangles, const Points& top, const Points& bottom)
      : triangles_(triangles),
        top_(top),
        bottom_(bottom),
        around_(vertex_neighbours(triangles, top.rows())),
        fans_(vertex_triangles(triangles, top.rows())),
        rank_(std::size_t(top.rows())) {
    std::iota(rank_.begin(), rank_.end(), 0.0);
  }

  void improve() {
    std::vector<char> next(rank_.size(), 0);
    for (Eigen::Index f = 0; f < triangles_.rows(); ++f)
      if (least_ratio(f) < flat)
        for (int k = 0; k < 3; ++k) next[std::size_t(triangles_(f, k))] = 1;
    for (int sweep = 0; sweep < sweeps; ++sweep) {
      bool changed = false;
      for (std::size_t v = 0; v < next.size(); ++v)
        if (next[v]) changed |= improve(v);
      if (!changed) break;
    }
  }
  const std::vector<double>& rank() const { return rank_; }

 private:
  template <class Use>
  void each_tet(Eigen::Index f, Use use) const {
    const std::array<int, 3> v{triangles_(f, 0), triangles_(f, 1), triangles_(f, 2)};
    for (const auto& tet : split_prism({rank_[v[0]], rank_[v[1]], rank_[v[2]]})) {
      std::array<Vec3, 4> x;
      for (int i = 0; i < 4; ++i)
        x[i] = (tet[i].below ? bottom_ : top_).row(v[tet[i].corner]).transpose();
      use(radius_ratio(x));
    }
  }
  double least_ratio(Eigen::Index f) const {
    double least = 1;
    each_tet(f, [&](double ratio) { least = std::min(least, ratio); });
    return least;
  }
  /// Sum of (1 / radius ratio)^4 over the prisms around a vertex: the flattest counts.
  double badness(std::size_t v) const {
    double sum = 0;
    for (const int f : fans_[v])
      each_tet(f, [&](double ratio) {
        sum += ratio > 0 ? std::pow(ratio, -4) : std::numeric_limits<double>::infinity();
      });
    return sum;
  }
  /// Tries each place of v's rank between those of its neighbours.
  bool improve(std::size_t v) {
    std::vector<double> others;
    for (const int w : around_[v]) others.push_back(rank_[std::size_t(w)]);
    std::sort(others.begin(), others.end());
    double best_rank = rank_[v], best = worth_it * badness(v);
    bool better = false;
    for (std::size_t k = 0; k <= others.size(); ++k) {
      // Neighbours of v that are not each other's may share a rank; v may not have it too.
      if (k > 0 && k < others.size() && others[k - 1] == others[k]) continue;
      rank_[v] = k == 0               ? others.front() - 1
                 : k == others.size() ? others.back() + 1
                                      : (others[k - 1] + others[k]) / 2;
      if (const double now = badness(v); now < best) {
        best = now;
        best_rank = rank_[v];
        better = true;
      }
    }
    rank_[v] = best_rank;
    return better;
  }

  const Triangles& triangles_;
  const Points &top_, &bottom_;
  std::vector<std::vector<int>> around_, fans_;
  std::vector<double> rank_;
};

}  // namespace

PrismTets split_prism(const std::array<double, 3>& rank) {
  int a = 0;  // of lowest rank
  if (rank[1] < rank[0] && rank[1] < rank[2]) a = 1;
  if (rank[2] < rank[0] && rank[2] < rank[1]) a = 2;
  const int b = (a + 1) % 3, c = (a + 2) % 3;
  // The top at a joins the bottoms at b and c; the diagonal over b-c depends on their order.
  if (rank[b] < rank[c])
    return {{{{{a, 0}, {b, 1}, {a, 1}, {c, 1}}},
             {{{a, 0}, {b, 0}, {b, 1}, {c, 1}}},
             {{{a, 0}, {b, 0}, {c, 1}, {c, 0}}}}};
  return {{{{{a, 0}, {b, 1}, {a, 1}, {c, 1}}},
           {{{a, 0}, {b, 1}, {c, 1}, {c, 0}}},
           {{{a, 0}, {b, 0}, {b, 1}, {c, 0}}}}};
}

std::vector<double> prism_ranks(const Triangles& triangles, const Points& top,
                                const Points& bottom) {
  Diagonals diagonals(triangles, top, bottom);
  diagonals.improve();
  return diagonals.rank();
}

double radius_ratio(const std::array<Vec3, 4>& x) {
  const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6;
  double surface = 0;
  constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (const auto& f : face) surface += 0.5 * (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]).norm();
  const double inradius = 3 * volume / surface;
  const double a = (x[1] - x[0]).norm() * (x[3] - x[2]).norm(),
               b = (x[2] - x[0]).norm() * (x[3] - x[1]).norm(),
               c = (x[3] - x[0]).norm() * (x[2] - x[1]).norm();
  const double product = std::max(0.0, (a + b + c) * (a + b - c) * (a - b + c) * (-a + b + c));
  const double circumradius = std::sqrt(product) / (24 * std::abs(volume));
  return volume == 0 ? 0 : 3 * inradius / circumradius;
}

}  // namespace hyperex::tissue
