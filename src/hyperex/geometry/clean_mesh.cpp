// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/clean_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <stdexcept>
#include <unordered_map>

#include "hyperex/geometry/directed_edges.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

using Tri = std::array<int, 3>;

/// Drops triangles until every directed edge is used at most once. This also drops triangles whose
/// orientation is opposite to that of their neighbours; a scan has few of these.
std::size_t drop_non_manifold(std::vector<Tri>& tris, std::vector<int>& source) {
  DirectedEdges used(3 * tris.size());
  std::vector<Tri> kept;
  std::vector<int> kept_source;
  for (std::size_t f = 0; f < tris.size(); ++f) {
    const Tri& t = tris[f];
    bool free_edges = true;
    for (int k = 0; k < 3; ++k) free_edges &= !used.contains(t[k], t[(k + 1) % 3]);
    if (!free_edges) continue;
    for (int k = 0; k < 3; ++k) used.insert(t[k], t[(k + 1) % 3]);
    kept.push_back(t);
    kept_source.push_back(source[f]);
  }
  const std::size_t dropped = tris.size() - kept.size();
  tris.swap(kept);
  source.swap(kept_source);
  return dropped;
}

/// Separates the fans of triangles at a pinched vertex: each gets its own copy of the vertex.
std::size_t split_pinched(std::vector<Tri>& tris, std::vector<int>& vertex_source) {
  const int count = static_cast<int>(vertex_source.size());
  std::vector<std::vector<std::pair<int, int>>> around(count);  // triangle, corner
  for (std::size_t f = 0; f < tris.size(); ++f)
    for (int k = 0; k < 3; ++k) around[tris[f][k]].push_back({static_cast<int>(f), k});
  std::size_t split = 0;
  for (int v = 0; v < count; ++v) {
    auto& fan = around[v];
    if (fan.size() < 2) continue;
    std::vector<int> group(fan.size());
    std::iota(group.begin(), group.end(), 0);
    const auto root = [&](int i) {
      while (group[i] != i) i = group[i] = group[group[i]];
      return i;
    };
    std::unordered_map<int, int> by_neighbour;
    for (std::size_t i = 0; i < fan.size(); ++i)
      for (int step = 1; step < 3; ++step) {
        const int w = tris[fan[i].first][(fan[i].second + step) % 3];
        const auto [it, fresh] = by_neighbour.try_emplace(w, static_cast<int>(i));
        if (!fresh) group[root(static_cast<int>(i))] = root(it->second);
      }
    std::map<int, int> copy_of_group;
    for (std::size_t i = 0; i < fan.size(); ++i) {
      const int g = root(static_cast<int>(i));
      if (!copy_of_group.count(g)) {
        if (copy_of_group.empty()) {
          copy_of_group[g] = v;
        } else {
          copy_of_group[g] = static_cast<int>(vertex_source.size());
          vertex_source.push_back(vertex_source[v]);
          ++split;
        }
      }
      tris[fan[i].first][fan[i].second] = copy_of_group[g];
    }
  }
  return split;
}

Triangles to_matrix(const std::vector<Tri>& tris) {
  Triangles m(tris.size(), 3);
  for (std::size_t f = 0; f < tris.size(); ++f) m.row(f) << tris[f][0], tris[f][1], tris[f][2];
  return m;
}

/// Keeps the triangles for which keep(f) holds; returns the number of removed ones.
template <class Keep>
std::size_t filter(std::vector<Tri>& tris, std::vector<int>& source, Keep keep) {
  std::size_t to = 0;
  for (std::size_t f = 0; f < tris.size(); ++f)
    if (keep(f)) {
      tris[to] = tris[f];
      source[to++] = source[f];
    }
  const std::size_t dropped = tris.size() - to;
  tris.resize(to);
  source.resize(to);
  return dropped;
}

std::size_t drop_islands(std::vector<Tri>& tris, std::vector<int>& source, const Points& points,
                         const std::vector<int>& vertex_source, double share) {
  const Triangles m = to_matrix(tris);
  const auto component = triangle_components(m, static_cast<Eigen::Index>(vertex_source.size()));
  std::vector<double> area;
  for (std::size_t f = 0; f < tris.size(); ++f) {
    if (component[f] >= static_cast<int>(area.size())) area.resize(component[f] + 1, 0.0);
    const Vec3 a = points.row(vertex_source[tris[f][0]]), b = points.row(vertex_source[tris[f][1]]),
               c = points.row(vertex_source[tris[f][2]]);
    area[component[f]] += 0.5 * (b - a).cross(c - a).norm();
  }
  if (area.size() < 2) return 0;
  const auto largest = std::max_element(area.begin(), area.end()) - area.begin();
  const double total = std::accumulate(area.begin(), area.end(), 0.0);
  std::size_t islands = 0;
  for (std::size_t i = 0; i < area.size(); ++i) {
    if (static_cast<std::ptrdiff_t>(i) == largest) continue;
    if (area[i] >= share * total)
      throw std::invalid_argument(
          fmt::format("consists of several large separate surfaces (one holds {:.0f} % of the "
                      "area); expected one "
                      "face",
                      100 * area[i] / total));
    ++islands;
  }
  filter(tris, source, [&](std::size_t f) { return component[f] == largest; });
  return islands;
}

}  // namespace

std::vector<int> first_at_same_place(const Points& points) {
  std::vector<int> order(points.rows());
  std::iota(order.begin(), order.end(), 0);
  const auto row = [&](int i) { return std::array{points(i, 0), points(i, 1), points(i, 2)}; };
  std::sort(order.begin(), order.end(),
            [&](int a, int b) { return std::pair(row(a), a) < std::pair(row(b), b); });
  std::vector<int> first(points.rows());
  for (std::size_t i = 0; i < order.size(); ++i)
    first[order[i]] = i > 0 && row(order[i]) == row(order[i - 1]) ? first[order[i - 1]] : order[i];
  return first;
}

CleanMesh clean_mesh(const TriMesh& mesh, const CleanOptions& options) {
  CleanMesh out;
  const auto note = [&](std::size_t count, const char* what) {
    if (count > 0) out.notes.push_back(fmt::format("{} {}", count, what));
  };
  std::vector<int> first(mesh.points.rows());
  std::iota(first.begin(), first.end(), 0);
  if (options.join_duplicates) first = first_at_same_place(mesh.points);
  std::vector<Tri> tris(mesh.triangles.rows());
  std::vector<int> source(tris.size());
  std::iota(source.begin(), source.end(), 0);
  for (std::size_t f = 0; f < tris.size(); ++f)
    for (int k = 0; k < 3; ++k) tris[f][k] = first[mesh.triangles(f, k)];
  std::size_t joined = 0;
  for (std::size_t v = 0; v < first.size(); ++v) joined += first[v] != static_cast<int>(v);
  note(joined, "duplicate vertices joined");

  const double tiny = 1e-14;  // m^2: a needle of 0.1 um on 0.2 mm
  note(filter(tris, source,
              [&](std::size_t f) {
                const Tri& t = tris[f];
                if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) return false;
                const Vec3 a = mesh.points.row(t[0]), b = mesh.points.row(t[1]),
                           c = mesh.points.row(t[2]);
                return 0.5 * (b - a).cross(c - a).norm() > tiny;
              }),
       "degenerate triangles dropped");
  note(drop_non_manifold(tris, source),
       "triangles dropped (turned against their neighbours, doubled, or a third one at an edge)");

  std::vector<int> vertex_source(mesh.points.rows());
  std::iota(vertex_source.begin(), vertex_source.end(), 0);
  note(split_pinched(tris, vertex_source), "pinched vertices parted");
  note(drop_islands(tris, source, mesh.points, vertex_source, options.island_area_share),
       "small islands dropped");
  if (tris.empty()) throw std::invalid_argument("has no usable triangles; expected a face surface");

  std::vector<int> compact(vertex_source.size(), -1);
  for (const Tri& t : tris)
    for (int v : t) compact[v] = 0;
  for (std::size_t v = 0; v < compact.size(); ++v)
    if (compact[v] == 0) {
      compact[v] = static_cast<int>(out.source_vertex.size());
      out.source_vertex.push_back(vertex_source[v]);
    }
  for (Tri& t : tris)
    for (int& v : t) v = compact[v];
  out.mesh.triangles = to_matrix(tris);
  out.mesh.points.resize(out.source_vertex.size(), 3);
  for (std::size_t v = 0; v < out.source_vertex.size(); ++v)
    out.mesh.points.row(v) = mesh.points.row(out.source_vertex[v]);
  out.source_triangle = std::move(source);
  return out;
}

TriMesh without_triangles(const TriMesh& mesh, const std::vector<char>& drop) {
  TriMesh kept{mesh.points, Triangles(mesh.triangles.rows(), 3)};
  Eigen::Index count = 0;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    if (!drop[f]) kept.triangles.row(count++) = mesh.triangles.row(f);
  kept.triangles.conservativeResize(count, 3);
  return clean_mesh(kept, {.join_duplicates = false}).mesh;
}

}  // namespace hyperex
