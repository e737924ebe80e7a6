// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/iso_surface.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>
#include <vector>

#include "hyperex/core/assert.hpp"

namespace hyperex::ct {
namespace {

constexpr double kClearOfEnds = 0.02;  // of an edge

/// Corner c of a cell lies at (c & 1, c >> 1 & 1, c >> 2). The tetrahedra are the six ways from
/// corner 0 to corner 7 along the axes, all positively oriented in index space.
constexpr std::array<std::array<int, 4>, 6> kTetrahedra = {
    {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};

class Marcher {
 public:
  Marcher(const Volume& volume, double iso_hu)
      : volume_(volume), iso_(float(iso_hu)), mirrored_(volume.step_m.determinant() < 0) {}

  TriMesh surface() {
    begin_plane(0);
    for (int k = 0; k + 1 < volume_.size[2]; ++k) {
      begin_plane(k + 1);
      for (int j = 0; j + 1 < volume_.size[1]; ++j)
        for (int i = 0; i + 1 < volume_.size[0]; ++i) cell(i, j, k);
    }
    TriMesh mesh;
    mesh.points = Eigen::Map<const Points>(points_.data(), Eigen::Index(points_.size() / 3), 3);
    mesh.triangles =
        Eigen::Map<const Triangles>(triangles_.data(), Eigen::Index(triangles_.size() / 3), 3);
    return mesh;
  }

 private:
  /// A corner of the grid.
  struct Corner {
    std::size_t at = 0;
    float value = 0;
    std::array<int, 3> index{};
    bool inside = false;
  };
  void cell(int i, int j, int k) {
    std::array<Corner, 8> corner;
    int inside = 0;
    for (int c = 0; c < 8; ++c) {
      Corner& one = corner[std::size_t(c)];
      one.index = {i + (c & 1), j + (c >> 1 & 1), k + (c >> 2)};
      one.at = volume_.at(one.index[0], one.index[1], one.index[2]);
      one.value = volume_.hu[one.at];
      if (std::isnan(one.value)) return;
      one.inside = one.value >= iso_;
      inside += one.inside ? 1 : 0;
    }
    if (inside == 0 || inside == 8) return;
    for (const auto& tetrahedron : kTetrahedra) cut(corner, tetrahedron);
  }

  void cut(const std::array<Corner, 8>& corner, std::array<int, 4> t) {
    const auto in = [&](int c) { return corner[std::size_t(c)].inside; };
    const auto count = std::count_if(t.begin(), t.end(), in);
    if (count == 0 || count == 4) return;
    // Even permutations alone: those of the same kind first.
    const auto turn = [&](int a, int b, int c) {
      const int first = t[std::size_t(a)];
      t[std::size_t(a)] = t[std::size_t(b)], t[std::size_t(b)] = t[std::size_t(c)],
      t[std::size_t(c)] = first;
    };
    const auto on = [&](int a, int b) {
      return vertex(corner[std::size_t(t[std::size_t(a)])], corner[std::size_t(t[std::size_t(b)])]);
    };
    if (count != 2) {
      const bool alone_inside = count == 1;
      int alone = 0;
      while (in(t[std::size_t(alone)]) != alone_inside) ++alone;
      if (alone == 1) turn(0, 1, 2);
      if (alone == 2) turn(0, 2, 3);
      if (alone == 3) turn(0, 3, 1);
      add(on(0, 1), on(0, 2), on(0, 3), alone_inside);
      return;
    }
    // Two inside: brought to the places 0 and 1.
    int second = 1;
    if (!in(t[0])) {
      int first = 1;
      while (!in(t[std::size_t(first)])) ++first;
      if (first == 1) turn(0, 1, 2);
      if (first == 2) turn(0, 2, 3);
      if (first == 3) turn(0, 3, 1);
    }
    while (!in(t[std::size_t(second)])) ++second;
    if (second == 2) turn(1, 2, 3);
    if (second == 3) turn(1, 3, 2);
    const int a = on(0, 2), b = on(0, 3), c = on(1, 3), d = on(1, 2);
    add(a, b, c, true);
    add(a, c, d, true);
  }

  void add(int a, int b, int c, bool first_inside) {
    if (first_inside == mirrored_) std::swap(b, c);
    triangles_.insert(triangles_.end(), {a, b, c});
  }

  int vertex(const Corner& one, const Corner& other) {
    const Corner& low = one.at < other.at ? one : other;
    const Corner& high = one.at < other.at ? other : one;
    const int way = (high.index[0] - low.index[0]) | (high.index[1] - low.index[1]) << 1 |
                    (high.index[2] - low.index[2]) << 2;
    int& known = edges_[std::size_t(low.index[2] & 1)]
                       [(low.at - volume_.at(0, 0, low.index[2])) * 8 + std::size_t(way)];
    if (known < 0) {
      known = int(points_.size() / 3);
      const double share = std::clamp(crossing(low, high, way), kClearOfEnds, 1 - kClearOfEnds);
      Vec3 index;
      for (int a = 0; a < 3; ++a)
        index[a] = low.index[std::size_t(a)] +
                   share * (high.index[std::size_t(a)] - low.index[std::size_t(a)]);
      const Vec3 p = volume_.place(index.x(), index.y(), index.z());
      points_.insert(points_.end(), {p.x(), p.y(), p.z()});
    }
    return known;
  }

  /// Where on the edge the multilinear interpolation of the values around it has the value, 0 to 1.
  /// On a diagonal these are the corners of its face or cell, whose places at equal shares t of all
  /// steps weigh the corners with b steps by t^b (1 - t)^(n - b).
  double crossing(const Corner& low, const Corner& high, int way) const {
    std::array<double, 4> sum{};  // by the number of steps
    const int steps = std::popcount(unsigned(way));
    for (int part = way;; part = (part - 1) & way) {
      sum[std::size_t(std::popcount(unsigned(part)))] +=
          double(volume_.hu[volume_.at(low.index[0] + (part & 1), low.index[1] + (part >> 1 & 1),
                                       low.index[2] + (part >> 2))]) -
          iso_;
      if (part == 0) break;
    }
    if (steps == 1) return sum[0] / (sum[0] - sum[1]);
    const auto value = [&](double t) {
      double out = 0;
      for (int b = 0; b <= steps; ++b)
        out += std::pow(t, b) * std::pow(1 - t, steps - b) * sum[std::size_t(b)];
      return out;
    };
    double from = 0, to = 1;
    for (int k = 0; k < 12; ++k) {
      const double middle = (from + to) / 2;
      ((value(middle) >= 0) == low.inside ? from : to) = middle;
    }
    HX_ASSERT(low.inside != high.inside);
    return (from + to) / 2;
  }

  /// Vertices on the edges that begin in plane k, by the value they begin at and their way: the
  /// bits of the steps along the three indices. Planes k and k + 1 are kept.
  void begin_plane(int k) {
    edges_[std::size_t(k & 1)].assign(std::size_t(volume_.size[0]) * volume_.size[1] * 8, -1);
  }

  const Volume& volume_;
  const float iso_;
  const bool mirrored_;
  std::vector<double> points_;
  std::vector<int> triangles_;
  std::array<std::vector<int>, 2> edges_;
};

}  // namespace

TriMesh iso_surface(const Volume& volume, double iso_hu) {
  return Marcher(volume, iso_hu).surface();
}

}  // namespace hyperex::ct
