// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/unfold.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::tissue {
namespace {

Vec3 face_normal(const TriMesh& mesh, int f) {
  const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
             c = mesh.points.row(mesh.triangles(f, 2));
  return (b - a).cross(c - a).normalized();
}

/// Neighbours to smooth with: a border's vertices keep to the border, or it would draw back.
std::vector<std::vector<int>> smoothing_neighbours(const TriMesh& mesh) {
  auto around = vertex_neighbours(mesh.triangles, mesh.points.rows());
  for (const auto& loop : boundary_loops(mesh.triangles))
    for (std::size_t i = 0; i < loop.size(); ++i)
      around[loop[i]] = {loop[(i + loop.size() - 1) % loop.size()], loop[(i + 1) % loop.size()]};
  return around;
}

/// Moves the flagged vertices and their neighbours half way to the mean around them; flags those.
void smooth_around(TriMesh& mesh, std::vector<char>& flagged,
                   const std::vector<std::vector<int>>& around) {
  std::vector<char> moved = flagged;
  for (std::size_t v = 0; v < around.size(); ++v)
    if (flagged[v])
      for (int w : around[v]) moved[w] = 1;
  const Points old = mesh.points;
  for (std::size_t v = 0; v < around.size(); ++v) {
    if (!moved[v] || around[v].empty()) continue;
    Vec3 mean = Vec3::Zero();
    for (int w : around[v]) mean += old.row(w).transpose();
    mean /= double(around[v].size());
    mesh.points.row(v) = 0.5 * (old.row(v) + mean.transpose());
  }
  flagged = std::move(moved);
}

}  // namespace

Visibility visibility_of(const TriMesh& mesh) {
  Visibility out{Points(mesh.points.rows(), 3), Eigen::VectorXd(mesh.points.rows())};
  update_visibility(mesh, std::vector<char>(mesh.points.rows(), 1),
                    vertex_triangles(mesh.triangles, mesh.points.rows()), out);
  return out;
}

void update_visibility(const TriMesh& mesh, const std::vector<char>& moved,
                       const std::vector<std::vector<int>>& fans, Visibility& visibility) {
  const Points start = vertex_normals(mesh);
  std::vector<Vec3> normals;
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    const bool stale = moved[v] || std::any_of(fans[v].begin(), fans[v].end(), [&](int f) {
                         return moved[mesh.triangles(f, 0)] || moved[mesh.triangles(f, 1)] ||
                                moved[mesh.triangles(f, 2)];
                       });
    if (!stale) continue;
    normals.clear();
    for (const int f : fans[v]) normals.push_back(face_normal(mesh, f));
    Vec3 d = start.row(v);
    visibility.direction.row(v) = d.transpose();
    double best = -2;
    for (int round = 0; round < 60; ++round) {
      double worst = 2;
      int worst_face = -1;
      for (std::size_t f = 0; f < normals.size(); ++f)
        if (const double c = normals[f].dot(d); c < worst)
          worst = c, worst_face = static_cast<int>(f);
      if (worst_face < 0) break;
      if (worst > best) {
        best = worst;
        visibility.direction.row(v) = d.transpose();
      }
      d = (d + normals[worst_face] / (round + 2.0)).normalized();
    }
    visibility.least[v] = best;
  }
}

TriMesh unfold(const TriMesh& mesh, std::vector<Note>& notes, double least) {
  TriMesh out = mesh;
  std::size_t smoothed = 0;
  Eigen::Index dropped = 0;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const auto around = smoothing_neighbours(out);
    const auto fans = vertex_triangles(out.triangles, out.points.rows());
    Visibility seen = visibility_of(out);
    std::vector<char> folded, moved;
    bool any = true;
    for (int round = 0; round < 12 && any; ++round) {
      if (round > 0) update_visibility(out, moved, fans, seen);
      folded.assign(out.points.rows(), 0);
      any = false;
      for (Eigen::Index v = 0; v < seen.least.size(); ++v)
        if (seen.least[v] < least) folded[v] = any = true;
      if (!any) break;
      if (round == 0 && attempt == 0)
        for (char f : folded) smoothed += f;
      moved = folded;
      smooth_around(out, moved, around);
    }
    if (!any) break;
    const Eigen::Index before = out.triangles.rows();
    out = without_triangles(out, touching(out.triangles, folded));
    dropped += before - out.triangles.rows();
  }
  if (smoothed > 0)
    notes.push_back(
        make_note("mesh.folds_smoothed",
                  fmt::format("the simulated skin was smoothed around {} folded nodes", smoothed)));
  if (dropped > 0)
    notes.push_back(make_note(
        "mesh.folds_dropped",
        fmt::format("{} triangles of the simulated skin were dropped in folds", dropped)));
  return out;
}

}  // namespace hyperex::tissue
