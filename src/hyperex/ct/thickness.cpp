// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/ct/thickness.hpp"

#include <tbb/parallel_for.h>

#include <cmath>
#include <limits>

#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/embree_device.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex::ct {
namespace {

constexpr double kNoBone = std::numeric_limits<double>::quiet_NaN();
constexpr double kBelowJaw_m = 5e-3, kEndOfJaw_m = 0.03;
constexpr double kForehead_m = 0.045, kHalfNose_m = 0.018, kBelowNose_m = 0.008;
constexpr double kHalfLips_m = 0.03, kHalfChin_m = 0.025, kAboveChin_m = 0.012;

/// Distance from `from` along `way` (unit length) to the first triangle, or NaN.
double first_hit(RTCScene scene, const Vec3& from, const Vec3& way) {
  RTCRayHit ray{};
  ray.ray.org_x = float(from.x()), ray.ray.org_y = float(from.y()), ray.ray.org_z = float(from.z());
  ray.ray.dir_x = float(way.x()), ray.ray.dir_y = float(way.y()), ray.ray.dir_z = float(way.z());
  ray.ray.tnear = 0;
  ray.ray.tfar = float(kMostThickness_m);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &ray);
  return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? kNoBone : double(ray.ray.tfar);
}

/// Normals of the vertices, each three times replaced by the mean over itself and its neighbours:
/// noise of the values tilts single triangles.
Points smooth_normals(const TriMesh& mesh) {
  Points normals = vertex_normals(mesh);
  const auto neighbours = vertex_neighbours(mesh.triangles, mesh.points.rows());
  for (int round = 0; round < 3; ++round) {
    const Points before = normals;
    for (Eigen::Index v = 0; v < normals.rows(); ++v) {
      for (const int other : neighbours[std::size_t(v)]) normals.row(v) += before.row(other);
      if (const double length = normals.row(v).norm(); length > 0) normals.row(v) /= length;
    }
  }
  return normals;
}

Region region_of(const Vec3& p, const FoundPoints& points) {
  const auto nose = points.skin.find("pronasale");
  if (nose == points.skin.end()) return Region::none;
  const Vec3 n = nose->second;
  const double across = p.x() - n.x();
  if (p.y() > n.y() + kForehead_m) return Region::forehead;
  if (std::abs(across) <= kHalfNose_m && p.y() > n.y() - kBelowNose_m) return Region::nose;
  const auto chin = points.skin.find("pogonion");
  if (chin != points.skin.end()) {
    const double above = p.y() - chin->second.y();
    if (std::abs(across) <= kHalfChin_m && above <= kAboveChin_m) return Region::chin;
    if (std::abs(across) <= kHalfLips_m && above > kAboveChin_m && p.y() <= n.y() - kBelowNose_m)
      return Region::lips;
  } else if (std::abs(across) <= kHalfLips_m && p.y() <= n.y() - kBelowNose_m) {
    return Region::none;  // without the chin's point, the border between lips and chin is not known
  }
  return across > 0 ? Region::cheek_left : Region::cheek_right;
}

}  // namespace

const char* name_of(Region region) {
  switch (region) {
    case Region::forehead:
      return "forehead";
    case Region::nose:
      return "nose";
    case Region::cheek_right:
      return "cheek_R";
    case Region::cheek_left:
      return "cheek_L";
    case Region::lips:
      return "lips";
    case Region::chin:
      return "chin";
    case Region::none:
      break;
  }
  return "none";
}

FaceBounds face_bounds(const TriMesh& skull, const TriMesh& mandible) {
  FaceBounds out;
  if (mandible.points.rows() == 0) {
    if (skull.points.rows() == 0) return out;
    out.back_z_m = (skull.points.col(2).minCoeff() + skull.points.col(2).maxCoeff()) / 2;
    out.chin_y_m = skull.points.col(1).minCoeff() - kBelowJaw_m;
    return out;
  }
  out.back_z_m = mandible.points.col(2).minCoeff();
  const double front_z = mandible.points.col(2).maxCoeff();
  Eigen::Index chin = -1, angle = -1;
  for (Eigen::Index v = 0; v < mandible.points.rows(); ++v) {
    const auto lower = [&](Eigen::Index than) {
      return than < 0 || mandible.points(v, 1) < mandible.points(than, 1);
    };
    if (mandible.points(v, 2) >= front_z - kEndOfJaw_m && lower(chin)) chin = v;
    if (mandible.points(v, 2) <= out.back_z_m + kEndOfJaw_m && lower(angle)) angle = v;
  }
  out.chin_z_m = mandible.points(chin, 2);
  out.chin_y_m = mandible.points(chin, 1) - kBelowJaw_m;
  const double length = out.chin_z_m - mandible.points(angle, 2);
  if (length > 1e-3) out.rise = (mandible.points(angle, 1) - mandible.points(chin, 1)) / length;
  return out;
}

Thickness measure_thickness(const TriMesh& skin, const TriMesh& bone, const FaceBounds& bounds,
                            const FoundPoints& points) {
  const Eigen::Index count = skin.points.rows();
  Thickness out{Eigen::VectorXd::Constant(count, kNoBone),
                Eigen::VectorXd::Constant(count, kNoBone),
                std::vector<Region>(std::size_t(count), Region::none)};
  if (bone.triangles.rows() == 0) return out;
  const Points normals = smooth_normals(skin);
  const SurfaceTree tree(bone);
  EmbreeScene scene;
  add_triangles(scene, bone.points, bone.triangles, 0);
  commit_whole(scene);
  tbb::parallel_for(Eigen::Index(0), count, [&](Eigen::Index v) {
    const Vec3 p = skin.points.row(v).transpose(), normal = normals.row(v).transpose();
    if (!bounds.holds(p)) return;
    const ClosestPoint near = tree.query(p, kMostThickness_m);
    if (near.triangle < 0) return;
    out.shortest_m[v] = std::sqrt(near.squared_distance);
    out.region[std::size_t(v)] = region_of(p, points);
    if (normal.squaredNorm() > 0.5) out.along_normal_m[v] = first_hit(scene, p, -normal);
  });
  return out;
}

}  // namespace hyperex::ct
