// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/lip_surfaces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "hyperex/face/face_frame.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::simulate {
namespace {

using Eigen::Index;
using Box = Eigen::AlignedBox3d;
constexpr double kOnEdge = 1e-6;  // a foot's weight: it lies on the edge opposite
// Deeper, the normal of the nearest place is not trusted alone: skin is folded at the corners.
constexpr double kPlain_m = 2e-5;
constexpr double kTouching_m = 1e-6;  // nearer, the direction to the foot is rounding

Box grown(const Box& box, double by) {
  return {box.min().array() - by, box.max().array() + by};
}

/// Two axes across a direction of unit length and the direction itself, right-handed, as columns.
Eigen::Matrix3d axes_along(const Vec3& forward) {
  Eigen::Matrix3d axes;
  axes.col(0) = forward.unitOrthogonal();
  axes.col(1) = forward.cross(axes.col(0));
  axes.col(2) = forward;
  return axes;
}

/// A box about points as seen along a direction.
class Outline {
 public:
  Outline(const Points& points, const Vec3& forward) : axes_(axes_along(forward)) {
    for (const Vec3& p : points.rowwise()) box_.extend(axes_.transpose() * p);
  }
  /// Whether who looks forward from `p` has some of the box before them.
  bool is_before(const Vec3& p) const {
    Vec3 at = axes_.transpose() * p;
    at[2] = std::max(at[2], box_.min()[2]);
    return box_.contains(at);
  }

 private:
  Eigen::Matrix3d axes_;
  Box box_;
};

/// A surface as seen along a direction, for many rays that way.
class ForwardRays {
 public:
  ForwardRays(const Points& points, const Triangles& triangles, Index count, const Vec3& forward)
      : triangles_(triangles), axes_(axes_along(forward)), seen_(points * axes_) {
    boxes_.resize(std::size_t(count));
    for (Index f = 0; f < count; ++f)
      for (const int v : triangles.row(f)) boxes_[std::size_t(f)].extend(seen_.row(v).transpose());
  }

  /// Whether the ray from `point` leaves the surface more often than it enters it. One that crosses
  /// a fold of skin in front of `point` enters and leaves.
  bool leaves(const Vec3& point) const {
    const Vec3 p = axes_.transpose() * point;
    int net = 0;
    for (std::size_t f = 0; f < boxes_.size(); ++f) {
      const Box& box = boxes_[f];
      if (p.x() < box.min().x() || p.x() > box.max().x() || p.y() < box.min().y() ||
          p.y() > box.max().y() || p.z() > box.max().z())
        continue;
      net += crossing(Index(f), p);
    }
    return net > 0;
  }

 private:
  /// 1: the ray leaves the surface through this triangle; -1: it enters it; 0: neither.
  int crossing(Index f, const Vec3& p) const {
    Eigen::Matrix3d to;  // the corners as seen from p, one per column
    for (int k = 0; k < 3; ++k) to.col(k) = seen_.row(triangles_(f, k)).transpose() - p;
    Vec3 weight;  // of the corner opposite each edge, times twice the area
    for (int k = 0; k < 3; ++k) {
      const auto a = to.col((k + 1) % 3), b = to.col((k + 2) % 3);
      weight[k] = a.x() * b.y() - a.y() * b.x();
    }
    const double area = weight.sum();
    if (area == 0 || (weight.minCoeff() < 0 && weight.maxCoeff() > 0)) return 0;
    if (weight.dot(to.row(2)) / area <= 0) return 0;
    return area > 0 ? 1 : -1;
  }

  const Triangles& triangles_;
  Eigen::Matrix3d axes_;
  Points seen_;  // two coordinates across the direction, one along it
  std::vector<Box> boxes_;
};

/// How many triangles have each edge.
std::map<std::pair<int, int>, int> uses_of_edges(const Triangles& triangles) {
  std::map<std::pair<int, int>, int> uses;
  for (Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) ++uses[std::minmax(triangles(f, k), triangles(f, (k + 1) % 3))];
  return uses;
}

/// One flag per vertex of the skin.
std::vector<char> near_lips(const Points& skin, const io::Landmarks& landmarks, double reach_m) {
  std::vector<char> near(std::size_t(skin.rows()), 0);
  for (Index v = 0; v < skin.rows(); ++v)
    for (int k = 61; k <= 67 && !near[std::size_t(v)]; ++k)
      near[std::size_t(v)] =
          k != 64 && (skin.row(v).transpose() - landmarks.at(face::ibug(k))).norm() < reach_m;
  return near;
}

}  // namespace

LipSurfaces::LipSurfaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const Points& skin = mesh.skin.points;
  const std::vector<char> near = near_lips(skin, landmarks, kReach_m);
  for (Index v = 0; v < skin.rows(); ++v)
    if (near[std::size_t(v)] && mesh.skin_upper_margin[std::size_t(v)] < 0)
      lower_.push_back(int(v));
  Faces faces = upper_faces(mesh, near);
  if (empty()) return;
  forward_ = face::face_frame(landmarks).z;
  extend_inwards(mesh, near, faces);
  find_neighbours(faces);
  lower_rest_ = skin(lower_, Eigen::all);
  upper_rest_ = skin(upper_, Eigen::all);
  allowed_m_.assign(lower_.size(), 0);
  for (const LipPair& pair : raw_pairs(lower_rest_, upper_rest_, 0))
    allowed_m_[std::size_t(pair.point)] = std::min(0.0, pair.gap_m);
}

LipSurfaces::Faces LipSurfaces::upper_faces(const tissue::TissueMesh& mesh,
                                            const std::vector<char>& near) {
  std::vector<int> place(near.size(), -1);  // in upper_
  Faces faces;
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
  return faces;
}

void LipSurfaces::extend_inwards(const tissue::TissueMesh& mesh, const std::vector<char>& near,
                                 Faces& faces) {
  follows_.resize(upper_.size());
  for (std::size_t i = 0; i < follows_.size(); ++i) follows_[i] = int(i);
  // The rim: edges of one triangle of the whole skin, not of this part of it alone.
  std::vector<Index> about;  // all triangles that share an edge with this part
  for (Index f = 0; f < mesh.skin.triangles.rows(); ++f) {
    const auto corners = mesh.skin.triangles.row(f);
    if (std::count_if(corners.begin(), corners.end(), [&](int v) { return near[std::size_t(v)]; }) >
        1)
      about.push_back(f);
  }
  const auto uses = uses_of_edges(mesh.skin.triangles(about, Eigen::all));
  std::map<int, int> behind;  // per vertex on the rim: the vertex inwards of it
  const auto inner = [&](int v) {
    const auto [at, is_new] = behind.emplace(v, int(follows_.size()));
    if (is_new) follows_.push_back(v);
    return at->second;
  };
  const std::size_t own = faces.size();
  own_triangles_ = Index(own);
  for (std::size_t f = 0; f < own; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces[f][k], b = faces[f][(k + 1) % 3];
      if (uses.at(std::minmax(upper_[std::size_t(a)], upper_[std::size_t(b)])) > 1) continue;
      const int a_in = inner(a), b_in = inner(b);
      faces.push_back({b, a, a_in});
      faces.push_back({b, a_in, b_in});
    }
  offset_.setZero(Index(follows_.size()), 3);
  for (const auto& [v, in] : behind) offset_.row(in) = -kInward_m * forward_.transpose();
}

void LipSurfaces::find_neighbours(const Faces& faces) {
  triangles_.resize(Index(faces.size()), 3);
  for (std::size_t f = 0; f < faces.size(); ++f)
    triangles_.row(Index(f)) << faces[f][0], faces[f][1], faces[f][2];
  around_ = vertex_triangles(triangles_, Index(follows_.size()));
  end_.assign(follows_.size(), 0);
  across_.assign(faces.size(), {-1, -1, -1});
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      const int a = faces[f][(k + 1) % 3], b = faces[f][(k + 2) % 3];
      for (const int other : around_[std::size_t(a)])
        if (const auto& o = faces[std::size_t(other)];
            other != int(f) && std::find(o.begin(), o.end(), b) != o.end())
          across_[f][k] = other;
      if (across_[f][k] < 0) end_[std::size_t(a)] = end_[std::size_t(b)] = 1;
    }
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

/// Inside and outside are decided correctly by the normal of a triangle, by the sum of both at an
/// edge and by that of all around at a vertex, each by its angle there (Baerentzen and Aanaes, IEEE
/// TVCG 11, 2005, 243). Nothing where the surface ends, since they are undefined there.
std::optional<Vec3> LipSurfaces::outward_at(const Points& points, std::size_t triangle,
                                            const Vec3& weights) const {
  const auto corner = [&](int f, int k) -> Vec3 { return points.row(triangles_(f, k)); };
  const auto normal = [&](int f) {
    return (corner(f, 1) - corner(f, 0)).cross(corner(f, 2) - corner(f, 0)).normalized().eval();
  };
  const int f = int(triangle);
  for (int k = 0; k < 3; ++k) {
    if (weights[k] < 1 - kOnEdge) continue;
    const int v = triangles_(f, k);
    if (end_[std::size_t(v)]) return std::nullopt;
    Vec3 sum = Vec3::Zero();
    for (const int other : around_[std::size_t(v)])
      for (int c = 0; c < 3; ++c)
        if (triangles_(other, c) == v) {
          const Vec3 a = corner(other, (c + 1) % 3) - corner(other, c);
          const Vec3 b = corner(other, (c + 2) % 3) - corner(other, c);
          sum += std::atan2(a.cross(b).norm(), a.dot(b)) * normal(other);
        }
    return sum;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    if (weights[Index(k)] > kOnEdge) continue;
    if (across_[triangle][k] < 0) return std::nullopt;
    return normal(f) + normal(across_[triangle][k]);
  }
  return normal(f);
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
  surface.triangles = triangles_(kept, Eigen::all);
  const SurfaceTree tree(surface);
  // Most vertices are outside and far off. Deeper than this a vertex counts only where its ray
  // leaves the upper lip, and so only within the skin's outline as seen from there.
  const double plain_m = std::max(kPlain_m, within_m);
  const Outline outline(upper, forward_);
  // The part that goes inwards from the rim lies along the rays, and is never crossed.
  const ForwardRays rays(surface.points, triangles_, own_triangles_, forward_);
  std::vector<LipPair> found;
  for (const int i : near) {
    const Vec3 p = lower.row(i);
    ClosestPoint foot = tree.query(p, plain_m);
    if (foot.triangle < 0 && outline.is_before(p)) foot = tree.query(p, look_m);
    if (foot.triangle < 0) continue;
    const auto f = std::size_t(kept[std::size_t(foot.triangle)]);
    const auto outward_there = outward_at(surface.points, f, foot.weights);
    if (!outward_there) continue;
    const Vec3 outward = *outward_there;
    const Vec3 to = p - foot.point;
    const double distance = to.norm();
    const bool outside = to.dot(outward) >= 0;
    if (!outside && distance > kPlain_m && !rays.leaves(p)) continue;
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

}  // namespace hyperex::simulate
