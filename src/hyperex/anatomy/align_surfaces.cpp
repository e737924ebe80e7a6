// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/align_surfaces.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "hyperex/core/quantile.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::anatomy {
namespace {

constexpr int kMostRounds = 60;
constexpr double kStill_m = 1e-7;
constexpr std::size_t kFewestPaired = 6;

Points moved(const Eigen::Isometry3d& by, const Points& points) {
  return (points * by.linear().transpose()).rowwise() + by.translation().transpose();
}

/// One flag per vertex on the border of the surface.
std::vector<char> on_border(const TriMesh& surface) {
  std::vector<char> out(std::size_t(surface.points.rows()), 0);
  for (const auto& loop : boundary_loops(surface.triangles))
    for (const int v : loop) out[std::size_t(v)] = 1;
  return out;
}

/// The small motion that brings points nearest to planes, in least squares.
Eigen::Isometry3d towards_planes(const std::vector<Vec3>& at, const std::vector<Vec3>& foot,
                                 const std::vector<Vec3>& normal) {
  Vec3 centre = Vec3::Zero();
  for (const Vec3& p : at) centre += p / double(at.size());
  Eigen::Matrix<double, 6, 6> h = Eigen::Matrix<double, 6, 6>::Zero();
  Eigen::Matrix<double, 6, 1> g = Eigen::Matrix<double, 6, 1>::Zero();
  for (std::size_t i = 0; i < at.size(); ++i) {
    Eigen::Matrix<double, 6, 1> row;
    row << (at[i] - centre).cross(normal[i]), normal[i];
    h += row * row.transpose();
    g += row * (foot[i] - at[i]).dot(normal[i]);
  }
  h.diagonal().array() += 1e-9 * h.diagonal().maxCoeff();
  const Eigen::Matrix<double, 6, 1> by = h.ldlt().solve(g);
  Eigen::Isometry3d out = Eigen::Isometry3d::Identity();
  if (const double angle = by.head<3>().norm(); angle > 0)
    out.linear() = Eigen::AngleAxisd(angle, by.head<3>() / angle).toRotationMatrix();
  out.translation() = centre - out.linear() * centre + by.tail<3>();
  return out;
}

}  // namespace

SurfaceAlignment align_to_surface(const Points& points, const TriMesh& surface,
                                  const Eigen::Isometry3d& start, double kept_share) {
  const SurfaceTree tree(surface);
  const std::vector<char> border = on_border(surface);
  const Points normals = vertex_normals(surface);
  const auto overhangs = [&](const ClosestPoint& c) {
    int at_border = 0;
    for (int k = 0; k < 3; ++k)
      at_border += c.weights[k] > 0 && border[std::size_t(surface.triangles(c.triangle, k))];
    const auto corners = (c.weights.array() > 0).count();
    return corners < 3 && at_border == corners;
  };
  SurfaceAlignment out{start, 0, 0};
  for (int round = 0; round < kMostRounds; ++round) {
    const Points now = moved(out.to_from_points, points);
    const std::vector<ClosestPoint> closest = tree.query_all(now);
    std::vector<std::size_t> use;
    for (std::size_t i = 0; i < closest.size(); ++i)
      if (!overhangs(closest[i])) use.push_back(i);
    const auto kept = std::size_t(kept_share * double(use.size()));
    if (kept < kFewestPaired) break;
    std::nth_element(use.begin(), use.begin() + std::ptrdiff_t(kept), use.end(),
                     [&](std::size_t a, std::size_t b) {
                       return closest[a].squared_distance < closest[b].squared_distance;
                     });
    std::vector<Vec3> at, foot, normal;
    for (std::size_t k = 0; k < kept; ++k) {
      const ClosestPoint& c = closest[use[k]];
      Vec3 n = Vec3::Zero();
      for (int corner = 0; corner < 3; ++corner)
        n += c.weights[corner] * normals.row(surface.triangles(c.triangle, corner)).transpose();
      at.push_back(now.row(Eigen::Index(use[k])));
      foot.push_back(c.point);
      normal.push_back(n.normalized());
    }
    const Eigen::Isometry3d by = towards_planes(at, foot, normal);
    out.to_from_points = by * out.to_from_points;
    const double turned = Eigen::AngleAxisd(by.linear()).angle();
    if ((by * at.front() - at.front()).norm() < kStill_m && 0.1 * turned < kStill_m) break;
  }
  out.to_from_points.linear() =
      Eigen::Quaterniond(out.to_from_points.linear()).normalized().toRotationMatrix();
  std::vector<double> apart;
  for (const ClosestPoint& c : tree.query_all(moved(out.to_from_points, points)))
    if (!overhangs(c)) apart.push_back(std::sqrt(c.squared_distance));
  if (!apart.empty()) {
    std::sort(apart.begin(), apart.end());
    out.median_m = quantile_of_sorted(apart, 0.5);
    out.p95_m = quantile_of_sorted(apart, 0.95);
  }
  return out;
}

}  // namespace hyperex::anatomy
