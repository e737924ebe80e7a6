// SPDX-License-Identifier: GPL-3.0-or-later
#include "ray_scene.hpp"

#include <algorithm>
#include <limits>

namespace hyperex::render {
namespace {

RTCRay downward_ray(float x, float y, float z_from, float z_to) {
  RTCRay ray{};
  ray.org_x = x;
  ray.org_y = y;
  ray.org_z = z_from;
  ray.dir_z = -1;
  ray.tnear = 0;
  ray.tfar = z_from - z_to;
  ray.mask = ~0u;
  return ray;
}

}  // namespace

RayScene::RayScene(const std::vector<Surface>& surfaces, const Camera& camera) {
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  const Eigen::Matrix3d camera_from_world = camera.axes();
  for (const Surface& surface : surfaces) {
    if (surface.mesh.triangles.rows() == 0) continue;
    Points seen(surface.mesh.points.rows(), 3);
    for (Eigen::Index i = 0; i < seen.rows(); ++i) {
      const Vec3 world = surface.mesh.points.row(i).transpose();
      seen.row(i) = (camera_from_world * (world - camera.target)).transpose();
      above_ = std::max(above_, static_cast<float>(seen(i, 2)));
    }
    add_triangles(scene_, seen, surface.mesh.triangles,
                  static_cast<unsigned>(&surface - surfaces.data()));
  }
  commit_whole(scene_);
  above_ *= 1.01f;
}

std::optional<Hit> RayScene::look_at(float x, float y) const {
  RTCRayHit query;
  query.ray = downward_ray(x, y, above_, -std::numeric_limits<float>::infinity());
  query.hit.geomID = query.hit.primID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  Hit hit;
  hit.surface = static_cast<int>(query.hit.geomID);
  hit.triangle = static_cast<int>(query.hit.primID);
  hit.weight[1] = query.hit.u;
  hit.weight[2] = query.hit.v;
  hit.weight[0] = 1.0 - query.hit.u - query.hit.v;
  hit.normal = Eigen::Vector3f(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z).normalized();
  return hit;
}

bool RayScene::hides(const Eigen::Vector3f& point, float bias) const {
  if (point[2] + bias >= above_) return false;
  RTCRay ray = downward_ray(point[0], point[1], above_, point[2] + bias);
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace hyperex::render
