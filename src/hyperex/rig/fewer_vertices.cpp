// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/rig/fewer_vertices.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "hyperex/face/ibug.hpp"
#include "hyperex/face/same_place.hpp"
#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/closed_line.hpp"
#include "hyperex/geometry/node_areas.hpp"
#include "hyperex/geometry/thin_mesh.hpp"
#include "hyperex/session/thinned_scan.hpp"

namespace hyperex::rig {
namespace {

/// A removed vertex may lie this share of an edge off the thinned surface.
constexpr double kOffShare = 1.0 / 8;
constexpr double kFirstEdge = 0.8, kLonger = 1.08;  // of an even mesh; of the round before
constexpr int kMostRounds = 30;

/// Skin at most this far from the outline of an eye or from the edge of the lips stays whole:
/// there lids and lips meet, fold and change their colour. Less far, if more than a share of the
/// vertices that may be left lie there.
constexpr double kBesideOpening_m = 5e-3;
constexpr double kShareBesideOpenings = 0.5;
/// First and last iBUG point of the closed lines: right eye, left eye, outer and inner lips.
constexpr std::pair<int, int> kOpenings[] = {{36, 41}, {42, 47}, {48, 59}, {60, 67}};

/// The closed line through iBUG points; empty where one is missing.
Points line_through(const io::Landmarks& landmarks, std::pair<int, int> ends) {
  Points line(ends.second - ends.first + 1, 3);
  for (int k = ends.first; k <= ends.second; ++k) {
    const std::optional<Vec3> at = face::find_place(landmarks, face::ibug(k));
    if (!at) return Points(0, 3);
    line.row(k - ends.first) = at->transpose();
  }
  return line;
}

/// The vertices beside the openings, the nearest ones first.
std::vector<int> beside_openings(const Points& points, const io::Landmarks& landmarks) {
  Eigen::VectorXd nearest_m = Eigen::VectorXd::Constant(points.rows(), kBesideOpening_m);
  for (const auto& ends : kOpenings) {
    const Points line = line_through(landmarks, ends);
    for (Eigen::Index v = 0; v < points.rows(); ++v)
      nearest_m[v] = std::min(nearest_m[v], distance_to_closed_line(points.row(v), line));
  }
  std::vector<int> beside;
  for (Eigen::Index v = 0; v < points.rows(); ++v)
    if (nearest_m[v] < kBesideOpening_m) beside.push_back(int(v));
  std::ranges::stable_sort(beside, {}, [&](int v) { return nearest_m[v]; });
  return beside;
}

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

ThinnedScan with_fewer_vertices(const io::Scan& scan, const io::Landmarks& landmarks,
                                Eigen::Index most) {
  if (scan.mesh.points.rows() <= most) return {scan};
  const CleanMesh clean = clean_mesh(scan.mesh);
  const std::vector<char> seams = session::on_seams(scan);
  std::vector<char> held(clean.source_vertex.size(), 0);
  for (std::size_t v = 0; v < held.size() && !seams.empty(); ++v)
    held[v] = seams[std::size_t(clean.source_vertex[v])];
  std::vector<int> beside = beside_openings(clean.mesh.points, landmarks);
  beside.resize(std::min(beside.size(), std::size_t(kShareBesideOpenings * double(most))));
  for (const int v : beside) held[std::size_t(v)] = 1;
  const ThinMesh thin = thinned_to(clean.mesh, most, held);
  return {session::thinned_scan(scan, session::skin_before_thinning(scan, clean, thin), thin.mesh),
          thin.greatest_distance_m};
}

}  // namespace hyperex::rig
