// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/lip_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::reenact {
namespace {

using Eigen::Index;
using Box = Eigen::AlignedBox3d;
constexpr double kOnEdge = 1e-6;      // a foot's weight: it lies on the edge opposite
constexpr double kTouching_m = 1e-6;  // nearer, the direction to the foot is rounding

Box grown(const Box& box, double by) {
  return {box.min().array() - by, box.max().array() + by};
}

/// How many triangles have each edge.
std::map<std::pair<int, int>, int> uses_of_edges(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(triangles(f, k), triangles(f, (k + 1) % 3))];
  return uses;
}

}  // namespace

LipSurfaces::LipSurfaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const Points& skin = mesh.skin.points;
  std::vector<char> near(std::size_t(skin.rows()), 0);
  for (Index v = 0; v < skin.rows(); ++v)
    for (int k = 61; k <= 67 && !near[std::size_t(v)]; ++k)
      near[std::size_t(v)] =
          k != 64 && (skin.row(v).transpose() - landmarks.at(face::ibug(k))).norm() < kReach_m;
  for (Index v = 0; v < skin.rows(); ++v)
    if (near[std::size_t(v)] && mesh.skin_upper_margin[std::size_t(v)] < 0)
      lower_.push_back(int(v));
  std::vector<int> place(std::size_t(skin.rows()), -1);  // among the upper ones
  std::vector<std::array<int, 3>> faces;
  std::map<std::pair<int, int>, int> of_skin;
  for (Index f = 0; f < mesh.skin.triangles.rows(); ++f) {
    const auto corners = mesh.skin.triangles.row(f);
    if (!std::all_of(corners.begin(), corners.end(), [&](int v) {
          return near[std::size_t(v)] && mesh.skin_upper_margin[std::size_t(v)] > 0;
        }))
      continue;
    std::array<int, 3> face{};
    for (int k = 0; k < 3; ++k) {
      int& at = place[std::size_t(corners[k])];
      if (at < 0) {
        at = int(upper_.size());
        upper_.push_back(corners[k]);
      }
      face[std::size_t(k)] = at;
    }
    faces.push_back(face);
  }
  if (empty()) return;
  follows_.resize(upper_.size());
  for (std::size_t i = 0; i < follows_.size(); ++i) follows_[i] = int(i);
  // The rim: edges that one triangle of the whole skin has, not of this part of it alone.
  const Vec3 inward = -kInward_m * face::face_frame(landmarks).z;
  std::vector<Index> about;  // all triangles that share an edge with this part
  for (Index f = 0; f < mesh.skin.triangles.rows(); ++f) {
    const auto corners = mesh.skin.triangles.row(f);
    if (std::count_if(corners.begin(), corners.end(), [&](int v) { return near[std::size_t(v)]; }) >
        1)
      about.push_back(f);
  }
  const auto uses = uses_of_edges(mesh.skin.triangles(about, Eigen::all));
  std::map<int, int> behind;  // of a vertex on the rim, the one that lies inwards of it
  const auto inner = [&](int v) {
    const auto [at, is_new] = behind.emplace(v, int(follows_.size()));
    if (is_new) follows_.push_back(v);
    return at->second;
  };
  const std::size_t own = faces.size();
  for (std::size_t f = 0; f < own; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces[f][k], b = faces[f][(k + 1) % 3];
      if (uses.at(std::minmax(upper_[std::size_t(a)], upper_[std::size_t(b)])) > 1) continue;
      const int a_in = inner(a), b_in = inner(b);
      faces.push_back({b, a, a_in});
      faces.push_back({b, a_in, b_in});
    }
  triangles_.resize(Index(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    triangles_.row(Index(f)) << faces[f][0], faces[f][1], faces[f][2];
  offset_.setZero(Index(follows_.size()), 3);
  for (const auto& [v, in] : behind) offset_.row(in) = inward.transpose();
  const auto uses_here = uses_of_edges(triangles_);
  end_.assign(follows_.size(), 0);
  open_edge_.assign(faces.size(), {});
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces[f][(k + 1) % 3], b = faces[f][(k + 2) % 3];
      if (uses_here.at(std::minmax(a, b)) > 1) continue;
      open_edge_[f][k] = 1;
      end_[std::size_t(a)] = end_[std::size_t(b)] = 1;
    }
  lower_rest_ = skin(lower_, Eigen::all);
  upper_rest_ = skin(upper_, Eigen::all);
  allowed_m_.assign(lower_.size(), 0);
  for (const LipPair& pair : raw_pairs(lower_rest_, upper_rest_, 0))
    allowed_m_[std::size_t(pair.point)] = std::min(0.0, pair.gap_m);
}

std::vector<LipPair> LipSurfaces::pairs(const Points& lower_displacement,
                                        const Points& upper_displacement, double within_m) const {
  if (empty()) return {};
  return raw_pairs(lower_rest_ + lower_displacement, upper_rest_ + upper_displacement, within_m);
}

double LipSurfaces::depth(const PointsF& skin_displacement) const {
  if (empty()) return 0;
  double deepest = 0;
  for (const LipPair& pair : pairs(skin_displacement(lower_, Eigen::all).cast<double>(),
                                   skin_displacement(upper_, Eigen::all).cast<double>(), 0))
    deepest = std::max(deepest, -pair.gap_m);
  return deepest;
}

std::vector<LipPair> LipSurfaces::raw_pairs(const Points& lower, const Points& upper,
                                            double within_m) const {
  TriMesh surface{upper(follows_, Eigen::all) + offset_, {}};
  // Parted lips are near each other at the corners of the mouth alone, or nowhere.
  const double look_m = std::max(kDeepest_m, within_m);
  Box of_upper, of_near;
  for (const Vec3& p : surface.points.rowwise()) of_upper.extend(p);
  of_upper = grown(of_upper, look_m);
  std::vector<int> near;
  for (Index i = 0; i < lower.rows(); ++i)
    if (const Vec3 p = lower.row(i); of_upper.contains(p)) {
      near.push_back(int(i));
      of_near.extend(p);
    }
  if (near.empty()) return {};
  of_near = grown(of_near, look_m);
  std::vector<Index> kept;
  for (Index f = 0; f < triangles_.rows(); ++f) {
    Box own;
    for (const int v : triangles_.row(f)) own.extend(surface.points.row(v).transpose());
    if (of_near.intersects(own)) kept.push_back(f);
  }
  if (kept.empty()) return {};
  const Points normals = vertex_normals({surface.points, triangles_});
  surface.triangles = triangles_(kept, Eigen::all);
  const SurfaceTree tree(surface);
  std::vector<LipPair> found;
  for (const int i : near) {
    const Vec3 p = lower.row(i);
    const ClosestPoint foot = tree.query(p, look_m);
    if (foot.triangle < 0) continue;
    const auto f = std::size_t(kept[std::size_t(foot.triangle)]);
    bool at_end = false;
    Vec3 outward = Vec3::Zero();
    for (int k = 0; k < 3; ++k) {
      const int v = triangles_(Index(f), k);
      at_end |= foot.weights[k] < kOnEdge && open_edge_[f][std::size_t(k)];
      at_end |= foot.weights[k] > 1 - kOnEdge && end_[std::size_t(v)];
      outward += foot.weights[k] * normals.row(v).transpose();
    }
    // Where the surface ends, nobody can tell inside from outside.
    if (at_end) continue;
    if (foot.weights.minCoeff() > kOnEdge) {
      const auto corner = [&](int k) -> Vec3 {
        return surface.points.row(triangles_(Index(f), k));
      };
      outward = (corner(1) - corner(0)).cross(corner(2) - corner(0));
    }
    const Vec3 to = p - foot.point;
    const double distance = to.norm();
    const bool outside = to.dot(outward) >= 0;
    LipPair pair;
    pair.gap_m =
        (outside ? distance : -distance) - (allowed_m_.empty() ? 0 : allowed_m_[std::size_t(i)]);
    if (pair.gap_m > within_m) continue;
    pair.point = i;
    pair.normal = distance > kTouching_m ? Vec3((outside ? 1 : -1) / distance * to)
                                         : Vec3(outward.normalized());
    pair.weight = foot.weights;
    for (int k = 0; k < 3; ++k)
      pair.on[std::size_t(k)] = follows_[std::size_t(triangles_(Index(f), k))];
    found.push_back(pair);
  }
  return found;
}

}  // namespace hyperex::reenact
