// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/plump.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace hyperex::tissue {
namespace {

constexpr int sweeps = 60;

/// The tetrahedra around one node, each turned so that the node comes first.
using Star = std::vector<std::array<int, 3>>;

struct Flatness {
  double value = 0;
  Vec3 gradient = Vec3::Zero();
};

/// sum (1/q)^4 with the star's node at x; infinite where a tetrahedron is flat or inverted.
Flatness flatness(const Points& nodes, const Star& star, const Vec3& x) {
  Flatness sum;
  for (const auto& others : star) {
    const Vec3 a = nodes.row(others[0]), b = nodes.row(others[1]), c = nodes.row(others[2]);
    // d(6 V) / dx: V = (a - x) . ((b - x) x (c - x)) / 6
    const Vec3 slope = -(b - a).cross(c - a);
    const double six = slope.dot(x - a);
    if (!(six > 0)) return {std::numeric_limits<double>::infinity(), Vec3::Zero()};
    const double edges = (a - x).squaredNorm() + (b - x).squaredNorm() + (c - x).squaredNorm() +
                         (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    const double inverse = edges / (12 * std::cbrt(six * six / 4));
    const double fourth = std::pow(inverse, 4);
    sum.value += fourth;
    sum.gradient += 4 * fourth * (2 * (3 * x - a - b - c) / edges - (2.0 / 3) * slope / six);
  }
  return sum;
}

std::vector<Star> stars_of(const Tetrahedra& tets, Eigen::Index nodes) {
  // Even permutations of the corners that bring each to the front.
  constexpr int turned[4][3] = {{1, 2, 3}, {0, 3, 2}, {3, 0, 1}, {2, 1, 0}};
  std::vector<Star> stars(nodes);
  for (Eigen::Index t = 0; t < tets.rows(); ++t)
    for (int k = 0; k < 4; ++k)
      stars[tets(t, k)].push_back(
          {tets(t, turned[k][0]), tets(t, turned[k][1]), tets(t, turned[k][2])});
  return stars;
}

}  // namespace

double radius_ratio(const Points& nodes, const Tetrahedra& tets, Eigen::Index tet) {
  Vec3 x[4];
  for (int k = 0; k < 4; ++k) x[k] = nodes.row(tets(tet, k));
  const double six = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]);
  double twice_surface = 0;
  constexpr int face[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (const auto& f : face) twice_surface += (x[f[1]] - x[f[0]]).cross(x[f[2]] - x[f[0]]).norm();
  const double inradius = six / twice_surface;
  const double a = (x[1] - x[0]).norm() * (x[3] - x[2]).norm(),
               b = (x[2] - x[0]).norm() * (x[3] - x[1]).norm(),
               c = (x[3] - x[0]).norm() * (x[2] - x[1]).norm();
  const double product = std::max(0.0, (a + b + c) * (a + b - c) * (a - b + c) * (-a + b + c));
  const double circumradius = std::sqrt(product) / (4 * std::abs(six));
  return 3 * inradius / circumradius;
}

Plumped plump_up(Points& nodes, const Tetrahedra& tets, Eigen::Index held, double least) {
  const std::vector<Star> stars = stars_of(tets, nodes.rows());
  const Points start = nodes;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    std::vector<char> flat(nodes.rows(), 0);
    for (Eigen::Index t = 0; t < tets.rows(); ++t)
      if (radius_ratio(nodes, tets, t) < least)
        for (int k = 0; k < 4; ++k) flat[tets(t, k)] = tets(t, k) >= held;
    bool moved = false;
    for (Eigen::Index v = held; v < nodes.rows(); ++v) {
      if (!flat[v]) continue;
      const Vec3 x = nodes.row(v);
      const Flatness now = flatness(nodes, stars[v], x);
      if (!(now.value < std::numeric_limits<double>::infinity()) || now.gradient.norm() == 0)
        continue;
      double reach = 0;
      for (const auto& others : stars[v])
        reach += (nodes.row(others[0]).transpose() - x).norm() / double(stars[v].size());
      // Backtracking along the gradient, from half an edge on.
      const Vec3 down = -now.gradient.normalized();
      for (double step = 0.5 * reach; step > 1e-4 * reach; step *= 0.5) {
        const Vec3 to = x + step * down;
        if (flatness(nodes, stars[v], to).value < now.value - 0.1 * step * now.gradient.norm()) {
          nodes.row(v) = to;
          moved = true;
          break;
        }
      }
    }
    if (!moved) break;
  }
  Plumped out;
  for (Eigen::Index v = held; v < nodes.rows(); ++v) {
    const double move = (nodes.row(v) - start.row(v)).norm();
    out.nodes += move > 0;
    out.greatest_move_m = std::max(out.greatest_move_m, move);
  }
  return out;
}

}  // namespace hyperex::tissue
