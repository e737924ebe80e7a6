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
constexpr double kBelowChin_m = 5e-3;
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
  if (mandible.points.rows() > 0) {
    out.back_z_m = mandible.points.col(2).minCoeff();
    out.low_y_m = mandible.points.col(1).minCoeff() - kBelowChin_m;
  } else if (skull.points.rows() > 0) {
    out.back_z_m = (skull.points.col(2).minCoeff() + skull.points.col(2).maxCoeff()) / 2;
    out.low_y_m = skull.points.col(1).minCoeff() - kBelowChin_m;
  }
  return out;
}

Thickness measure_thickness(const TriMesh& skin, const TriMesh& bone, const FaceBounds& bounds,
                            const FoundPoints& points) {
  const Eigen::Index count = skin.points.rows();
  Thickness out{Eigen::VectorXd::Constant(count, kNoBone), Eigen::VectorXd::Constant(count, kNoBone),
                std::vector<Region>(std::size_t(count), Region::none)};
  if (bone.triangles.rows() == 0) return out;
  const Points normals = vertex_normals(skin);
  const SurfaceTree tree(bone);
  EmbreeScene scene;
  add_triangles(scene, bone.points, bone.triangles, 0);
  commit_whole(scene);
  tbb::parallel_for(Eigen::Index(0), count, [&](Eigen::Index v) {
    const Vec3 p = skin.points.row(v).transpose(), normal = normals.row(v).transpose();
    if (p.z() < bounds.back_z_m || p.y() < bounds.low_y_m) return;
    const ClosestPoint near = tree.query(p, kMostThickness_m);
    if (near.triangle < 0) return;
    out.shortest_m[v] = std::sqrt(near.squared_distance);
    out.region[std::size_t(v)] = region_of(p, points);
    if (normal.squaredNorm() > 0.5) out.along_normal_m[v] = first_hit(scene, p, -normal);
  });
  return out;
}

}  // namespace hyperex::ct
