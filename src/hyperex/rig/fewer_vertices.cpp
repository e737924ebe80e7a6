// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/fewer_vertices.hpp"

#include <cmath>
#include <numeric>
#include <vector>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/thin_mesh.hpp"
#include "hyperex/session/thinned_scan.hpp"

namespace hyperex::rig {
namespace {

/// A removed vertex may lie this share of an edge off the thinned surface.
constexpr double kOffShare = 1.0 / 8;
constexpr double kFirstEdge = 0.8, kLonger = 1.08;  // of an even mesh; of the round before
constexpr int kMostRounds = 30;

ThinMesh thinned_to(const TriMesh& mesh, Eigen::Index most, const std::vector<char>& held) {
  // Equilateral triangles, two for each vertex.
  double edge_m =
      kFirstEdge * std::sqrt(node_areas(mesh).sum() / (std::sqrt(3.0) / 2 * double(most)));
  for (int round = 0;; ++round, edge_m *= kLonger) {
    ThinMesh thin = thin_mesh(
        mesh,
        {.edge_m = edge_m, .tolerance_m = kOffShare * edge_m, .enough_vertices = std::size_t(most)},
        held);
    if (thin.mesh.points.rows() <= most || round == kMostRounds) return thin;
  }
}

}  // namespace

ThinnedScan with_fewer_vertices(const io::Scan& scan, Eigen::Index most) {
  if (scan.mesh.points.rows() <= most) return {scan};
  const CleanMesh clean = clean_mesh(scan.mesh);
  const std::vector<char> seams = session::on_seams(scan);
  std::vector<char> held(clean.source_vertex.size(), 0);
  for (std::size_t v = 0; v < held.size() && !seams.empty(); ++v)
    held[v] = seams[std::size_t(clean.source_vertex[v])];
  const ThinMesh thin = thinned_to(clean.mesh, most, held);
  tissue::FullSkin full;
  full.skin = scan.mesh;
  full.scan_vertices = scan.mesh.points.rows();
  full.source_triangle.resize(std::size_t(scan.mesh.triangles.rows()));
  std::iota(full.source_triangle.begin(), full.source_triangle.end(), 0);
  for (const int v : thin.source_vertex) full.kept.push_back(clean.source_vertex[std::size_t(v)]);
  for (const int f : thin.source_triangle)
    full.kept_triangle.push_back(clean.source_triangle[std::size_t(f)]);
  return {session::thinned_scan(scan, full, thin.mesh), thin.greatest_distance_m};
}

}  // namespace hyperex::rig
