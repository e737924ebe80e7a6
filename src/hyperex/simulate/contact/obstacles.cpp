// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/simulate/contact/obstacles.hpp"

#include <algorithm>
#include <limits>

#include "hyperex/anatomy/eyeballs.hpp"
#include "hyperex/face/ibug.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::simulate {
namespace {

using Eigen::Index;

double distance_to_points(const Vec3& place, const Points& points) {
  return points.rows() == 0 ? std::numeric_limits<double>::infinity()
                            : (points.rowwise() - place.transpose()).rowwise().norm().minCoeff();
}

Points ibug_points(const io::Landmarks& landmarks, int first, int last) {
  Points out(last - first + 1, 3);
  for (int k = first; k <= last; ++k) out.row(k - first) = landmarks.at(face::ibug(k)).transpose();
  return out;
}

/// Vertices where the skin ends, as near to points as that.
std::vector<int> border_near(const TriMesh& skin, const Points& points, double within_m) {
  std::vector<int> out;
  for (const std::vector<int>& loop : boundary_loops(skin.triangles))
    for (const int v : loop)
      if (distance_to_points(skin.points.row(v), points) < within_m) out.push_back(v);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

std::vector<Obstacle> teeth_obstacles(const anatomy::Teeth& teeth) {
  std::vector<Obstacle> out;
  for (const bool lower : {false, true})
    if (auto shape = anatomy::distance_to(lower ? teeth.lower : teeth.upper))
      out.push_back({Obstacle::Kind::teeth, std::move(shape), lower});
  return out;
}

std::vector<Obstacle> eye_obstacles(const Points& skin, const io::Landmarks& landmarks) {
  std::vector<Obstacle> out;
  if (const auto corners = anatomy::face_corners(landmarks))
    for (const anatomy::Eyeball& eye : anatomy::eyeballs_behind(skin, *corners))
      out.push_back({Obstacle::Kind::eye,
                     std::make_shared<const SphereDistance>(eye.centre, eye.radius_m), false});
  return out;
}

ObstaclePlaces::ObstaclePlaces(const tissue::TissueMesh& mesh, const io::Landmarks& landmarks,
                               Obstacle obstacle)
    : obstacle_(std::move(obstacle)) {
  constexpr double kRim_m = 0.006;  // of landmarks: another border is no lip and no lid
  const Points& skin = mesh.skin.points;
  if (obstacle_.kind == Obstacle::Kind::teeth) {
    const Points lips = ibug_points(landmarks, 48, 67);
    skin_ = border_near(mesh.skin, ibug_points(landmarks, 60, 67), kRim_m);
    for (int v = 0; v < int(mesh.volume.surface_nodes()); ++v)
      if (distance_to_points(mesh.volume.outer.points.row(v), lips) < kMouth_m)
        nodes_.push_back(mesh.volume.inner_node(v));
  } else {
    const std::vector<int> border = border_near(mesh.skin, ibug_points(landmarks, 36, 47), kRim_m);
    const Points rims = skin(border, Eigen::all);
    Eigen::AlignedBox3d about;
    for (const Vec3& p : rims.rowwise()) about.extend(p);
    for (Index v = 0; v < skin.rows() && !border.empty(); ++v)
      if (const Vec3 p = skin.row(v); about.exteriorDistance(p) < kLid_m)
        if (distance_to_points(p, rims) < kLid_m) skin_.push_back(int(v));
  }
  rest_.resize(Index(skin_.size() + nodes_.size()), 3);
  rest_ << skin(skin_, Eigen::all), mesh.volume.nodes(nodes_, Eigen::all);
  allowed_m_.assign(std::size_t(count()), 0);
  for (Index i = 0; i < count(); ++i) {
    Vec3 outward;
    allowed_m_[std::size_t(i)] = std::min(0.0, obstacle_.shape->at(rest_.row(i), outward));
  }
}

Points ObstaclePlaces::moved(const PointsF& skin, const Eigen::Ref<const Points>& nodes) const {
  Points out(count(), 3);
  out << skin(skin_, Eigen::all).cast<double>(), nodes(nodes_, Eigen::all);
  return out;
}

double ObstaclePlaces::gap_m(Index i, const Vec3& displacement,
                             const Eigen::Isometry3d& now_from_rest, Vec3& outward) const {
  const Vec3 now = rest_.row(i).transpose() + displacement;
  const double distance = obstacle_.shape->at(now_from_rest.inverse() * now, outward);
  outward = now_from_rest.linear() * outward;
  return distance - allowed_m_[std::size_t(i)];
}

double ObstaclePlaces::depth(const Points& displacement,
                             const Eigen::Isometry3d& now_from_rest) const {
  double deepest = 0;
  Vec3 outward;
  for (Index i = 0; i < count(); ++i)
    deepest = std::max(deepest, -gap_m(i, displacement.row(i), now_from_rest, outward));
  return deepest;
}

}  // namespace hyperex::simulate
