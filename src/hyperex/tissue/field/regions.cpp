// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/field/regions.hpp"

#include <algorithm>
#include <cmath>

#include "hyperex/anatomy/embedded_face.hpp"
#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/smooth_step.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::tissue {
namespace {

constexpr double kFarthest_m = 0.010;
constexpr double kLineStep_m = 0.0005;

std::string without_side(const std::string& name) {
  return name.ends_with("_L") || name.ends_with("_R") ? name.substr(0, name.size() - 2) : name;
}

const FacialRegion* find_region(const std::string& name) {
  for (const FacialRegion& region : facial_regions())
    if (region.name == name) return &region;
  return nullptr;
}

/// 1 inside, 0 outside, evened out between neighbours so that the border runs smoothly; vertices
/// inside stay above 1/2, the others below.
Eigen::VectorXd indicator(const FacialRegion& region, const Triangles& triangles,
                          Eigen::Index vertices) {
  constexpr double own = 0.55;
  Eigen::VectorXd inside = Eigen::VectorXd::Zero(vertices), even = inside;
  for (const int v : region.vertices) inside[v] = 1;
  const auto around = vertex_neighbours(triangles, vertices);
  for (Eigen::Index v = 0; v < vertices; ++v) {
    double mean = around[v].empty() ? inside[v] : 0;
    for (const int w : around[v]) mean += inside[w] / double(around[v].size());
    even[v] = own * inside[v] + (1 - own) * mean;
  }
  return even;
}

/// Segments as triangles collapsed to them, for closest points.
TriMesh as_mesh(const std::vector<Vec3>& ends) {
  TriMesh mesh{Points(Eigen::Index(ends.size()), 3), Triangles(Eigen::Index(ends.size() / 2), 3)};
  for (std::size_t i = 0; i < ends.size(); ++i) mesh.points.row(Eigen::Index(i)) = ends[i];
  for (int s = 0; s < mesh.triangles.rows(); ++s)
    mesh.triangles.row(s) << 2 * s, 2 * s + 1, 2 * s + 1;
  return mesh;
}

/// The line where a linear field over a mesh, nowhere 1/2 at a vertex, takes the value 1/2.
std::vector<Vec3> border_of(const TriMesh& mesh, const Eigen::VectorXd& inside) {
  std::vector<Vec3> ends;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) {
      // The corner on the other side than the two others.
      const int a = mesh.triangles(f, k), b = mesh.triangles(f, (k + 1) % 3),
                c = mesh.triangles(f, (k + 2) % 3);
      const bool in = inside[a] > 0.5;
      if (in == (inside[b] > 0.5) || in == (inside[c] > 0.5)) continue;
      for (const int other : {b, c}) {
        const double t = (0.5 - inside[a]) / (inside[other] - inside[a]);
        ends.push_back(((1 - t) * mesh.points.row(a) + t * mesh.points.row(other)).transpose());
      }
    }
  return ends;
}

/// On the canonical face, above 0 on the upper lip, below on the lower one, 0 elsewhere.
std::vector<double> lip_margins(Eigen::Index vertices) {
  std::vector<double> margin(vertices, 0);
  for (const int v : find_region("upper_lip")->vertices) margin[v] += 1;
  for (const int v : find_region("lower_lip")->vertices) margin[v] -= 1;
  return margin;
}

}  // namespace

RegionMap::RegionMap(const TissueMesh& mesh, const io::Landmarks& landmarks,
                     const anatomy::RegisteredFace& face) {
  const anatomy::CanonicalFace& canonical = anatomy::canonical_face();
  open_ = {face.points, face::opened_triangles(canonical)};
  const face::FaceFrame frame = face::face_frame(landmarks);
  const double reach = 1.8 * (landmarks.at(face::ibug(54)) - frame.origin).norm();
  const SideTree tree(open_, lip_margins(open_.points.rows()), frame.origin, reach);
  const Eigen::VectorXd lateral = face.scan_from_canonical.scale * canonical.mesh.points.col(0);
  foot_.resize(mesh.skin.points.rows());
  lateral_m_.resize(mesh.skin.points.rows());
  for (Eigen::Index v = 0; v < mesh.skin.points.rows(); ++v) {
    foot_[v] = tree.query(mesh.skin.points.row(v), mesh.skin_upper_margin[v]);
    lateral_m_[v] = foot_[v].value(lateral);
  }
}

Eigen::VectorXd RegionMap::depth(const std::string& name) const {
  const FacialRegion& region = *find_region(without_side(name));
  const Eigen::VectorXd inside = indicator(region, open_.triangles, open_.points.rows());
  const std::vector<Vec3> border = border_of(open_, inside);
  std::optional<SurfaceTree> tree;
  if (!border.empty()) tree.emplace(as_mesh(border));
  const double side = name == region.name ? 0 : name.ends_with("_L") ? 1 : -1;
  Eigen::VectorXd out(Eigen::Index(foot_.size()));
  for (std::size_t v = 0; v < foot_.size(); ++v) {
    Vec3 at = Vec3::Zero();
    for (int k = 0; k < 3; ++k)
      at += foot_[v].weight[k] * open_.points.row(foot_[v].vertex[k]).transpose();
    const double far = tree ? std::sqrt(tree->query(at).squared_distance) : kFarthest_m;
    double depth = foot_[v].value(inside) >= 0.5 ? far : -far;
    if (side != 0) depth = std::min(depth, side * lateral_m_[Eigen::Index(v)]);
    out[Eigen::Index(v)] = std::min(depth, kFarthest_m - foot_[v].distance_m);
  }
  return out;
}

Eigen::VectorXd band_depth(const TriMesh& skin, const std::vector<Vec3>& line, double width_m) {
  const SurfaceTree surface(skin);
  std::vector<Vec3> laid;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const int steps =
        std::max(1, static_cast<int>(std::ceil((line[i + 1] - line[i]).norm() / kLineStep_m)));
    for (int s = i == 0 ? 0 : 1; s <= steps; ++s)
      laid.push_back(surface.query(line[i] + double(s) / steps * (line[i + 1] - line[i])).point);
  }
  std::vector<Vec3> ends;
  for (std::size_t i = 0; i + 1 < laid.size(); ++i) ends.insert(ends.end(), {laid[i], laid[i + 1]});
  const auto near = SurfaceTree(as_mesh(ends)).query_all(skin.points);
  Eigen::VectorXd depth(skin.points.rows());
  for (Eigen::Index v = 0; v < depth.size(); ++v)
    depth[v] = width_m / 2 - std::sqrt(near[v].squared_distance);
  return depth;
}

double region_share(double depth_m, double blend_m) {
  if (blend_m <= 0) return depth_m >= 0 ? 1 : 0;
  return smooth_step(depth_m / blend_m + 0.5);
}

}  // namespace hyperex::tissue
