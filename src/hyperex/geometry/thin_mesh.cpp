// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/thin_mesh.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

using Tri = std::array<int, 3>;

/// The cosine of 45 degrees; least quality of a triangle (1: equilateral, 0: no area).
constexpr double kLeastCosine = std::numbers::sqrt2 / 2, kLeastQuality = 0.25;
constexpr double kLongest = 1.6;  // greatest edge length, relative to edge_m
// Greatest number of triangles around a vertex that may be removed.
constexpr std::size_t kMostAround = 24;
constexpr std::size_t kTried = 3;  // number of neighbours tried per vertex, nearest first
// Least share of the vertices that a pass must remove for another one.
constexpr double kWorthAnotherPass = 0.03;

class Thinner {
 public:
  Thinner(const TriMesh& mesh, const ThinOptions& options, const std::vector<char>& held)
      : options_(options),
        points_(mesh.points),
        triangles_(std::size_t(mesh.triangles.rows())),
        around_(vertex_triangles(mesh.triangles, mesh.points.rows())),
        merged_into_(std::size_t(mesh.points.rows()), -1),
        held_(std::size_t(mesh.points.rows()), 0),
        touched_(held_.size(), 0),
        next_(held_.size(), -1),
        last_(held_.size(), -1),
        alive_(held_.size()) {
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      for (int k = 0; k < 3; ++k)
        triangles_[f][std::size_t(k)] = mesh.triangles(Eigen::Index(f), k);
    std::copy(held.begin(), held.end(), held_.begin());
    for (const auto& loop : boundary_loops(mesh.triangles))
      for (const int v : loop) held_[std::size_t(v)] = 1;
    std::iota(last_.begin(), last_.end(), 0);
    tolerance_m_ = options.tolerance_m;
  }

  void thin() {
    collapse_all();
    for (int k = 0; k < 2 && alive_ > options_.enough_vertices; ++k) {
      tolerance_m_ *= 2;
      collapse_all();
    }
  }

  ThinMesh result() {
    ThinMesh out;
    std::vector<int> number(merged_into_.size(), -1);
    for (std::size_t v = 0; v < number.size(); ++v)
      if (merged_into_[v] < 0) {
        number[v] = int(out.source_vertex.size());
        out.source_vertex.push_back(int(v));
      }
    out.mesh.points.resize(Eigen::Index(out.source_vertex.size()), 3);
    for (std::size_t v = 0; v < out.source_vertex.size(); ++v)
      out.mesh.points.row(Eigen::Index(v)) = points_.row(out.source_vertex[v]);
    for (std::size_t f = 0; f < triangles_.size(); ++f)
      if (triangles_[f][0] >= 0) out.source_triangle.push_back(int(f));
    out.mesh.triangles.resize(Eigen::Index(out.source_triangle.size()), 3);
    for (std::size_t f = 0; f < out.source_triangle.size(); ++f)
      for (int k = 0; k < 3; ++k)
        out.mesh.triangles(Eigen::Index(f), k) =
            number[std::size_t(triangles_[std::size_t(out.source_triangle[f])][std::size_t(k)])];
    place_all(number, out);
    return out;
  }

 private:
  Vec3 at(int v) const { return points_.row(v).transpose(); }
  std::vector<int>& around(int v) { return around_[std::size_t(v)]; }
  const Tri& triangle(int f) const { return triangles_[std::size_t(f)]; }

  static bool has(const Tri& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

  double mean_edge() const {
    double sum = 0;
    std::size_t count = 0;
    for (const Tri& t : triangles_) {
      if (t[0] < 0) continue;
      for (int k = 0; k < 3; ++k)
        sum += (at(t[std::size_t(k)]) - at(t[std::size_t((k + 1) % 3)])).norm();
      count += 3;
    }
    return count ? sum / double(count) : options_.edge_m;
  }

  /// The length is increased in steps, so that the remaining vertices stay evenly distributed.
  void collapse_all() {
    double length_m = std::min(mean_edge(), options_.edge_m);
    for (;;) {
      for (;;) {
        const std::size_t before = alive_;
        pass(length_m);
        if (double(before - alive_) < kWorthAnotherPass * double(before)) break;
      }
      if (length_m >= options_.edge_m) return;
      length_m = std::min(length_m * std::numbers::sqrt2, options_.edge_m);
    }
  }

  void pass(double length_m) {
    std::fill(touched_.begin(), touched_.end(), 0);
    for (std::size_t u = 0; u < held_.size(); ++u)
      if (merged_into_[u] < 0 && !held_[u] && !touched_[u]) try_vertex(int(u), length_m);
  }

  void neighbours_of(int v, std::vector<int>& list) const {
    list.clear();
    for (const int f : around_[std::size_t(v)])
      for (const int w : triangle(f))
        if (w != v) list.push_back(w);
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }

  void try_vertex(int u, double length_m) {
    if (around(u).size() > kMostAround) return;
    neighbours_of(u, neighbours_);
    candidates_.clear();
    for (const int v : neighbours_)
      if (const double d = (at(u) - at(v)).norm(); d <= length_m) candidates_.emplace_back(d, v);
    std::sort(candidates_.begin(), candidates_.end());
    for (std::size_t i = 0; i < std::min(kTried, candidates_.size()); ++i)
      if (fits(u, candidates_[i].second)) {
        collapse(u, candidates_[i].second);
        return;
      }
  }

  static double quality(const Vec3& a, const Vec3& b, const Vec3& c) {
    return 2 * std::numbers::sqrt3 * (b - a).cross(c - a).norm() /
           ((b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm());
  }

  /// Whether merging the vertex whose neighbours are in `neighbours_` into v preserves the
  /// topology.
  bool keeps_topology(int v) {
    neighbours_of(v, others_);
    int common = 0;
    for (const int w : neighbours_) common += std::binary_search(others_.begin(), others_.end(), w);
    return common == 2;
  }

  bool fits(int u, int v) {
    if (!keeps_topology(v)) return false;
    for (const int w : neighbours_)
      if (w != v && (at(v) - at(w)).norm() > kLongest * options_.edge_m) return false;
    star_.clear();
    for (const int f : around(u)) {
      const Tri& t = triangle(f);
      if (has(t, v)) continue;
      Tri moved = t;
      std::replace(moved.begin(), moved.end(), u, v);
      const Vec3 before = (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0]));
      const Vec3 after = (at(moved[1]) - at(moved[0])).cross(at(moved[2]) - at(moved[0]));
      if (after.dot(before) < kLeastCosine * after.norm() * before.norm()) return false;
      const double better = std::min(kLeastQuality, quality(at(t[0]), at(t[1]), at(t[2])));
      if (quality(at(moved[0]), at(moved[1]), at(moved[2])) < better) return false;
      star_.push_back(moved);
    }
    for (const int f : around(v))
      if (!has(triangle(f), u)) star_.push_back(triangle(f));
    return near(u, star_) && near(next_[std::size_t(v)], star_) && neighbours_stay_near(u, v);
  }

  /// Whether the vertices merged earlier into the other neighbours stay near the triangles around
  /// these, as they will be after the collapse.
  bool neighbours_stay_near(int u, int v) {
    for (const int w : neighbours_) {
      if (w == v || next_[std::size_t(w)] < 0) continue;
      around_one_.clear();
      for (const int f : around(w))
        if (!has(triangle(f), u)) around_one_.push_back(triangle(f));
      for (const Tri& t : star_)
        if (has(t, w)) around_one_.push_back(t);
      if (!near(next_[std::size_t(w)], around_one_)) return false;
    }
    return true;
  }

  /// Whether the vertex and those after it in its list are each within the tolerance of one of the
  /// triangles.
  bool near(int first, const std::vector<Tri>& triangles) const {
    for (int p = first; p >= 0; p = next_[std::size_t(p)])
      if (std::none_of(triangles.begin(), triangles.end(), [&](const Tri& t) {
            return closest_point_on_triangle(at(p), at(t[0]), at(t[1]), at(t[2]))
                       .squared_distance <= tolerance_m_ * tolerance_m_;
          }))
        return false;
    return true;
  }

  void collapse(int u, int v) {
    for (const int f : around(u)) {
      Tri& t = triangles_[std::size_t(f)];
      if (has(t, v)) {
        for (const int w : t)
          if (w != u) std::erase(around(w), f);
        t = {-1, -1, -1};
      } else {
        std::replace(t.begin(), t.end(), u, v);
        around(v).push_back(f);
      }
    }
    std::vector<int>().swap(around(u));
    merged_into_[std::size_t(u)] = v;
    next_[std::size_t(last_[std::size_t(v)])] = u;  // append u's list to v's
    last_[std::size_t(v)] = last_[std::size_t(u)];
    touched_[std::size_t(v)] = 1;
    --alive_;
  }

  int kept_for(int v) const {
    while (merged_into_[std::size_t(v)] >= 0) v = merged_into_[std::size_t(v)];
    return v;
  }

  /// The closest points, searched among the triangles around the vertex that it was merged into and
  /// those around the neighbours of that vertex.
  void place_all(const std::vector<int>& number, ThinMesh& out) const {
    out.places.resize(merged_into_.size());
    std::vector<double> distance2(merged_into_.size(), 0);
    tbb::parallel_for(std::size_t(0), out.places.size(), [&](std::size_t v) {
      if (merged_into_[v] < 0) {
        out.places[v].vertex.fill(number[v]);
        return;
      }
      ClosestPoint best;
      best.squared_distance = std::numeric_limits<double>::infinity();
      for (const int near : around_[std::size_t(kept_for(int(v)))])
        for (const int w : triangle(near))
          for (const int f : around_[std::size_t(w)]) {
            const Tri& t = triangle(f);
            const ClosestPoint found =
                closest_point_on_triangle(at(int(v)), at(t[0]), at(t[1]), at(t[2]));
            if (found.squared_distance >= best.squared_distance) continue;
            best = found;
            best.triangle = f;
          }
      for (std::size_t k = 0; k < 3; ++k)
        out.places[v].vertex[k] = number[std::size_t(triangle(best.triangle)[k])];
      out.places[v].weight = best.weights;
      distance2[v] = best.squared_distance;
    });
    if (!distance2.empty())
      out.greatest_distance_m = std::sqrt(*std::max_element(distance2.begin(), distance2.end()));
  }

  const ThinOptions& options_;
  const Points& points_;
  double tolerance_m_ = 0;
  std::vector<Tri> triangles_;            // -1 for a removed triangle
  std::vector<std::vector<int>> around_;  // triangles of each vertex
  std::vector<int> merged_into_;          // -1 for a vertex that remains
  std::vector<char> held_, touched_;
  /// Linked lists of removed vertices, each starting at the vertex they were merged into; the last
  /// entry of each list.
  std::vector<int> next_, last_;
  std::size_t alive_;
  std::vector<int> neighbours_, others_;
  std::vector<std::pair<double, int>> candidates_;
  std::vector<Tri> star_, around_one_;
};

}  // namespace

ThinMesh thin_mesh(const TriMesh& mesh, const ThinOptions& options, const std::vector<char>& held) {
  Thinner thinner(mesh, options, held);
  thinner.thin();
  return thinner.result();
}

}  // namespace hyperex
