// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/lips.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "hyperex/geometry/geodesic.hpp"
#include "hyperex/geometry/surface_topology.hpp"
#include "hyperex/tissue/face_frame.hpp"

namespace hyperex::tissue {
namespace {

std::vector<int> vertices_near(const TriMesh& mesh, const io::Landmarks& landmarks,
                               std::initializer_list<int> numbers) {
  std::vector<int> vertices;
  for (int k : numbers) vertices.push_back(nearest_vertex(mesh.points, landmarks.at(ibug(k))));
  return vertices;
}

/// Right corner, the inner lip line, left corner: each inner point the mean of upper and lower.
std::vector<Vec3> lip_line(const io::Landmarks& landmarks) {
  const auto mean = [&](int a, int b) {
    return Vec3(0.5 * (landmarks.at(ibug(a)) + landmarks.at(ibug(b))));
  };
  return {landmarks.at(ibug(48)), landmarks.at(ibug(60)), mean(61, 67),          mean(62, 66),
          mean(63, 65),           landmarks.at(ibug(64)), landmarks.at(ibug(54))};
}

double distance_to_polyline(const Vec3& p, const std::vector<Vec3>& line) {
  double best = 1e300;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Vec3 e = line[i + 1] - line[i];
    const double t = std::clamp((p - line[i]).dot(e) / std::max(1e-18, e.squaredNorm()), 0.0, 1.0);
    best = std::min(best, (p - line[i] - t * e).norm());
  }
  return best;
}

/// How far a vertex lies under the mean of its neighbours, as a share of their mean distance: above
/// 0 in a valley.
std::vector<double> concavity(const TriMesh& mesh) {
  const Points normals = vertex_normals(mesh);
  const auto around = vertex_neighbours(mesh.triangles, mesh.points.rows());
  std::vector<double> value(mesh.points.rows(), 0.0);
  for (std::size_t v = 0; v < value.size(); ++v) {
    if (around[v].empty()) continue;
    Vec3 mean = Vec3::Zero();
    double length = 0;
    for (int w : around[v]) {
      mean += mesh.points.row(w).transpose();
      length += (mesh.points.row(w) - mesh.points.row(v)).norm();
    }
    mean /= double(around[v].size());
    length /= double(around[v].size());
    value[v] = (mean - mesh.points.row(v).transpose()).dot(normals.row(v)) / length;
  }
  return value;
}

}  // namespace

int lip_of(const std::string& landmark) {
  for (int k : {49, 50, 51, 52, 53, 61, 62, 63})
    if (landmark == ibug(k)) return 1;
  for (int k : {55, 56, 57, 58, 59, 65, 66, 67})
    if (landmark == ibug(k)) return -1;
  return 0;
}

std::vector<double> upper_lip_margin(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const EdgePaths paths(mesh);
  const auto upper = paths.distances(vertices_near(mesh, landmarks, {50, 51, 52}));
  const auto lower = paths.distances(vertices_near(mesh, landmarks, {56, 57, 58}));
  std::vector<double> margin(upper.size());
  constexpr double far = 1;  // m
  for (std::size_t v = 0; v < margin.size(); ++v)
    margin[v] = std::min(lower[v], far) - std::min(upper[v], far);
  return margin;
}

bool mouth_is_open(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const std::vector<Vec3> line = lip_line(landmarks);
  const Vec3 corner_r = line.front(), across = line.back() - line.front();
  const double width = across.norm();
  for (const auto& loop : boundary_loops(mesh.triangles)) {
    double least = 1e300, greatest = -1e300;
    for (int v : loop) {
      const Vec3 p = mesh.points.row(v);
      if (distance_to_polyline(p, line) > 0.25 * width) continue;
      const double along = (p - corner_r).dot(across) / (width * width);
      least = std::min(least, along);
      greatest = std::max(greatest, along);
    }
    if (greatest - least > 0.5) return true;
  }
  return false;
}

std::vector<int> lip_crease(const TriMesh& mesh, const io::Landmarks& landmarks) {
  const std::vector<Vec3> line = lip_line(landmarks);
  const std::vector<double> hollow = concavity(mesh);
  const double width = (line.back() - line.front()).norm();
  const auto cost = [&](int a, int b) {
    const Vec3 p = mesh.points.row(a), q = mesh.points.row(b);
    const double off = distance_to_polyline(0.5 * (p + q), line) / (0.08 * width);
    const double valley = std::clamp(0.5 * (hollow[a] + hollow[b]), -0.2, 0.4);
    return (p - q).norm() * std::exp(-10 * valley) * (1 + off * off);
  };
  const int from = nearest_vertex(mesh.points, line.front()),
            to = nearest_vertex(mesh.points, line.back());
  std::vector<int> path = EdgePaths(mesh).cheapest(from, to, cost);
  if (path.size() < 3) throw std::runtime_error("no walk on the surface joins the mouth corners");
  return path;
}

}  // namespace hyperex::tissue
