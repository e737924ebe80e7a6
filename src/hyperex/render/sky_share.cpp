// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/render/sky_share.hpp"

#include <tbb/parallel_for.h>

#include <array>
#include <cmath>
#include <numbers>

#include "hyperex/geometry/embree_device.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::render {
namespace {

constexpr int kRays = 48;
/// Rays leave this far before the surface, or they would meet the triangles around their vertex.
constexpr double kClear_m = 4e-4;

/// Even over a disc, lifted to the hemisphere: weighted by the cosine (Malley's method; Pharr,
/// Jakob and Humphreys, "Physically Based Rendering", 2016, 13.6.3). The disc is Vogel's spiral.
std::array<Vec3, kRays> directions() {
  std::array<Vec3, kRays> out;
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  for (int i = 0; i < kRays; ++i) {
    const double radius = std::sqrt((i + 0.5) / kRays), turn = golden * i;
    out[std::size_t(i)] = {radius * std::cos(turn), radius * std::sin(turn),
                           std::sqrt(1 - radius * radius)};
  }
  return out;
}

}  // namespace

Eigen::VectorXf sky_share(const TriMesh& mesh, const Points& places, const Points& normals,
                          double far_m) {
  const Eigen::Index count = places.rows();
  Eigen::VectorXf share = Eigen::VectorXf::Ones(count);
  if (mesh.triangles.rows() == 0) return share;
  EmbreeScene scene;
  add_triangles(scene, mesh.points, mesh.triangles, 0);
  commit_whole(scene);
  const std::array<Vec3, kRays> before = directions();
  tbb::parallel_for(Eigen::Index(0), count, [&](Eigen::Index v) {
    const Vec3 normal = normals.row(v);
    if (!(normal.squaredNorm() > 0.5)) return;
    const Vec3 x = normal.unitOrthogonal(), y = normal.cross(x);
    const Vec3 from = places.row(v).transpose() + kClear_m * normal;
    int met = 0;
    for (const Vec3& d : before)
      met += meets(scene, from, d.x() * x + d.y() * y + d.z() * normal, 0, far_m) ? 1 : 0;
    share[v] = 1 - float(met) / kRays;
  });
  return share;
}

Eigen::VectorXf sky_share(const TriMesh& mesh, double far_m) {
  return sky_share(mesh, mesh.points, vertex_normals(mesh), far_m);
}

}  // namespace hyperex::render
