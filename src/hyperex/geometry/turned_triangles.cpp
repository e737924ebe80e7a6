// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/turned_triangles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"

namespace hyperex {
namespace {

/// An edge by its vertices, the smaller one first, and whether a triangle runs from that to the
/// other. Sorted by the edge.
std::vector<std::uint64_t> runs_along_edges(const TriMesh& mesh) {
  const std::vector<int> first = first_at_same_place(mesh.points);
  std::vector<std::uint64_t> runs;
  runs.reserve(std::size_t(mesh.triangles.size()));
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      const auto from = std::uint64_t(first[std::size_t(mesh.triangles(f, k))]);
      const auto to = std::uint64_t(first[std::size_t(mesh.triangles(f, (k + 1) % 3))]);
      if (from != to)
        runs.push_back(std::min(from, to) << 33 | std::max(from, to) << 1 |
                       std::uint64_t(from < to));
    }
  std::ranges::sort(runs);
  return runs;
}

}  // namespace

double turned_edge_share(const TriMesh& mesh) {
  const std::vector<std::uint64_t> runs = runs_along_edges(mesh);
  std::size_t joined = 0, turned = 0;
  for (std::size_t i = 0, next = 0; i < runs.size(); i = next) {
    while (next < runs.size() && runs[next] >> 1 == runs[i] >> 1) ++next;
    if (next - i != 2) continue;
    ++joined;
    turned += runs[i] == runs[i + 1];
  }
  return joined == 0 ? 0 : double(turned) / double(joined);
}

std::string turned_triangles_doubt(const TriMesh& mesh) {
  constexpr double few = 0.02;
  const double share = turned_edge_share(mesh);
  if (share <= few) return "";
  return fmt::format(
      "some of its triangles are turned inside out: at {:.0f} % of the edges the two triangles run "
      "the same way; expected all to run counter-clockwise as seen from outside, as Re-Orient All "
      "Faces Coherently of MeshLab turns them",
      100 * share);
}

}  // namespace hyperex
