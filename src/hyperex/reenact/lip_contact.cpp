// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/reenact/lip_contact.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/closest_point.hpp"

namespace hyperex::reenact {
namespace {
constexpr double lip_reach_m = 0.010;  // of the inner lip points
constexpr double deepest_m = 0.006;    // farther behind is another part of the face, not a lip

using Box = Eigen::AlignedBox3d;

Box grown(const Box& box) {
  return {box.min().array() - deepest_m, box.max().array() + deepest_m};
}

/// With those triangles alone that reach into the box.
TriMesh part_in(const Box& box, const TriMesh& mesh) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    Box own;
    for (const int v : mesh.triangles.row(f)) own.extend(mesh.points.row(v).transpose());
    if (box.intersects(own)) kept.push_back(f);
  }
  return {mesh.points, mesh.triangles(kept, Eigen::all)};
}
}  // namespace

LipContact::LipContact(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks) {
  const Points& skin = mesh.skin.points;
  std::vector<char> near(skin.rows(), 0);
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    for (int k = 61; k <= 67 && !near[v]; ++k)
      near[v] =
          k != 64 && (skin.row(v).transpose() - landmarks.at(face::ibug(k))).norm() < lip_reach_m;
  for (Eigen::Index v = 0; v < skin.rows(); ++v)
    if (near[v] && mesh.skin_upper_margin[v] < 0) lower_.push_back(static_cast<int>(v));
  std::vector<Eigen::Index> kept;
  std::vector<int> place(static_cast<std::size_t>(skin.rows()), -1);  // among the upper ones
  for (Eigen::Index f = 0; f < mesh.skin.triangles.rows(); ++f) {
    bool keep = true;
    for (int k = 0; k < 3; ++k) {
      const int v = mesh.skin.triangles(f, k);
      keep &= near[v] && mesh.skin_upper_margin[v] > 0;
    }
    if (!keep) continue;
    kept.push_back(f);
    for (const int v : mesh.skin.triangles.row(f))
      if (place[v] < 0) {
        place[v] = static_cast<int>(upper_.size());
        upper_.push_back(v);
      }
  }
  upper_rest_.triangles.resize(kept.size(), 3);
  for (std::size_t i = 0; i < kept.size(); ++i)
    for (int k = 0; k < 3; ++k)
      upper_rest_.triangles(i, k) = place[mesh.skin.triangles(kept[i], k)];
  upper_rest_.points = skin(upper_, Eigen::all);
  lower_rest_ = skin(lower_, Eigen::all);
  at_rest_ = raw_depth(lower_rest_, upper_rest_);
}

double LipContact::depth(const PointsF& displacement) const {
  TriMesh upper = upper_rest_;
  upper.points += displacement(upper_, Eigen::all).cast<double>();
  const Points lower = lower_rest_ + displacement(lower_, Eigen::all).cast<double>();
  return std::max(0.0, raw_depth(lower, upper) - at_rest_);
}

double LipContact::raw_depth(const Points& lower, const TriMesh& upper) const {
  // Parted lips are near each other at the corners of the mouth alone, or nowhere.
  Box of_upper, of_near;
  for (const Vec3& p : upper.points.rowwise()) of_upper.extend(p);
  of_upper = grown(of_upper);
  std::vector<Vec3> near;
  for (const Vec3& p : lower.rowwise())
    if (of_upper.contains(p)) {
      near.push_back(p);
      of_near.extend(p);
    }
  if (near.empty()) return 0;
  const TriMesh part = part_in(grown(of_near), upper);
  if (part.triangles.rows() == 0) return 0;
  const SurfaceTree tree(part);
  double deepest = 0;
  for (const Vec3& p : near) {
    const ClosestPoint c = tree.query(p, deepest_m);
    if (c.triangle < 0) continue;
    // A foot on the rim of the lip says nothing about inside and outside.
    if (c.weights.minCoeff() < 1e-6) continue;
    const auto corner = [&](int k) -> Vec3 {
      return part.points.row(part.triangles(c.triangle, k));
    };
    const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0)).normalized();
    const double height = (p - c.point).dot(normal);
    if (height < 0) deepest = std::max(deepest, -height);
  }
  return deepest;
}

}  // namespace hyperex::reenact
