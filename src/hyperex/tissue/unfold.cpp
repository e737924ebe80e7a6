// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/unfold.hpp"

#include <fmt/format.h>

#include "hyperex/geometry/clean_mesh.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::tissue {
namespace {

Points face_normals(const TriMesh& mesh) {
  Points normals(mesh.triangles.rows(), 3);
  for (Eigen::Index f = 0; f < normals.rows(); ++f) {
    const Vec3 a = mesh.points.row(mesh.triangles(f, 0)), b = mesh.points.row(mesh.triangles(f, 1)),
               c = mesh.points.row(mesh.triangles(f, 2));
    normals.row(f) = (b - a).cross(c - a).normalized().transpose();
  }
  return normals;
}

/// Neighbours to smooth with: a border's vertices keep to the border, or it would draw back.
std::vector<std::vector<int>> smoothing_neighbours(const TriMesh& mesh) {
  auto around = vertex_neighbours(mesh.triangles, mesh.points.rows());
  for (const auto& loop : boundary_loops(mesh.triangles))
    for (std::size_t i = 0; i < loop.size(); ++i)
      around[loop[i]] = {loop[(i + loop.size() - 1) % loop.size()], loop[(i + 1) % loop.size()]};
  return around;
}

/// Moves the flagged vertices and their neighbours half way to the mean around them.
void smooth_around(TriMesh& mesh, const std::vector<char>& flagged,
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
}

}  // namespace

Visibility visibility_of(const TriMesh& mesh) {
  Visibility out{vertex_normals(mesh), Eigen::VectorXd::Zero(mesh.points.rows())};
  const Points normals = face_normals(mesh);
  const auto fans = vertex_triangles(mesh.triangles, mesh.points.rows());
  for (Eigen::Index v = 0; v < mesh.points.rows(); ++v) {
    Vec3 d = out.direction.row(v);
    double best = -2;
    for (int round = 0; round < 60; ++round) {
      double worst = 2;
      int worst_face = -1;
      for (int f : fans[v])
        if (const double c = normals.row(f).dot(d); c < worst) worst = c, worst_face = f;
      if (worst_face < 0) break;
      if (worst > best) {
        best = worst;
        out.direction.row(v) = d.transpose();
      }
      d = (d + normals.row(worst_face).transpose() / (round + 2.0)).normalized();
    }
    out.least[v] = best;
  }
  return out;
}

TriMesh unfold(const TriMesh& mesh, std::vector<std::string>& notes, double least) {
  TriMesh out = mesh;
  std::size_t smoothed = 0;
  Eigen::Index dropped = 0;
  for (int attempt = 0; attempt < 8; ++attempt) {
    const auto around = smoothing_neighbours(out);
    std::vector<char> folded;
    bool any = true;
    for (int round = 0; round < 12 && any; ++round) {
      const Eigen::VectorXd seen = visibility_of(out).least;
      folded.assign(out.points.rows(), 0);
      any = false;
      for (Eigen::Index v = 0; v < seen.size(); ++v)
        if (seen[v] < least) folded[v] = any = true;
      if (!any) break;
      if (round == 0 && attempt == 0)
        for (char f : folded) smoothed += f;
      smooth_around(out, folded, around);
    }
    if (!any) break;
    const Eigen::Index before = out.triangles.rows();
    out = without_triangles(out, touching(out.triangles, folded));
    dropped += before - out.triangles.rows();
  }
  if (smoothed > 0)
    notes.push_back(
        fmt::format("the simulated skin was smoothed around {} folded nodes", smoothed));
  if (dropped > 0)
    notes.push_back(
        fmt::format("{} triangles of the simulated skin were dropped in folds", dropped));
  return out;
}

}  // namespace hyperex::tissue
