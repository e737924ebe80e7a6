// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/short_border_edges.hpp"

#include <algorithm>
#include <iterator>
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

constexpr double least_cosine = 0.5;   // of the angle by which a triangle may be rotated
constexpr std::size_t least_loop = 4;  // number of edges that a border keeps at least

struct BorderEdge {
  double share;  // share of the required length
  int kept, removed;
};

Vec3 area_vector(const TriMesh& mesh, Eigen::Index f, int from, int to) {
  Vec3 x[3];
  for (int k = 0; k < 3; ++k) {
    const int v = mesh.triangles(f, k);
    x[k] = mesh.points.row(v == from ? to : v);
  }
  return (x[1] - x[0]).cross(x[2] - x[0]);
}

/// For a border vertex, the cosine of the angle between its two border edges: 1 at the end of a
/// slit.
double sharpness(const TriMesh& mesh, const std::vector<int>& loop, std::size_t i) {
  const auto at = [&](std::size_t k) { return Vec3(mesh.points.row(loop[k % loop.size()])); };
  const Vec3 here = at(i);
  return (at(i + 1) - here).normalized().dot((at(i + loop.size() - 1) - here).normalized());
}

std::vector<BorderEdge> short_edges(const TriMesh& mesh, const GradedSize& size,
                                    double least_share) {
  std::vector<BorderEdge> found;
  for (const auto& loop : boundary_loops(mesh.triangles)) {
    if (loop.size() <= least_loop) continue;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t j = (i + 1) % loop.size();
      const Vec3 a = mesh.points.row(loop[i]), b = mesh.points.row(loop[j]);
      const double share = (b - a).norm() / size.at((a + b) / 2);
      if (!(share < least_share)) continue;
      const bool first = sharpness(mesh, loop, i) >= sharpness(mesh, loop, j);
      found.push_back({share, first ? loop[i] : loop[j], first ? loop[j] : loop[i]});
    }
  }
  std::sort(found.begin(), found.end(),
            [](const BorderEdge& a, const BorderEdge& b) { return a.share < b.share; });
  return found;
}

/// Merges `removed` into `kept`, if the surface remains a manifold without new folds.
bool join(TriMesh& mesh, int kept, int removed) {
  const auto around = vertex_neighbours(mesh.triangles, mesh.points.rows());
  std::vector<int> common;
  std::set_intersection(around[kept].begin(), around[kept].end(), around[removed].begin(),
                        around[removed].end(), std::back_inserter(common));
  if (common.size() != 1) return false;  // the third corner of the edge's triangle alone
  const auto fans = vertex_triangles(mesh.triangles, mesh.points.rows());
  std::vector<char> drop(mesh.triangles.rows(), 0);
  for (const int f : fans[removed]) {
    const auto corners = mesh.triangles.row(f);
    if ((corners.array() == kept).any()) {
      drop[f] = 1;
      continue;
    }
    const Vec3 before = area_vector(mesh, f, removed, removed),
               after = area_vector(mesh, f, removed, kept);
    if (!(before.dot(after) > least_cosine * before.norm() * after.norm())) return false;
  }
  for (const int f : fans[removed])
    for (int k = 0; k < 3; ++k)
      if (mesh.triangles(f, k) == removed) mesh.triangles(f, k) = kept;
  mesh = without_triangles(mesh, drop);
  return true;
}

}  // namespace

int remove_short_border_edges(TriMesh& mesh, const GradedSize& size, double least_share) {
  int removed = 0;
  for (bool again = true; again;) {
    again = false;
    // A removal renumbers the vertices.
    for (const BorderEdge& edge : short_edges(mesh, size, least_share))
      if (join(mesh, edge.kept, edge.removed)) {
        ++removed;
        again = true;
        break;
      }
  }
  return removed;
}

}  // namespace hyperex
