// SPDX-License-Identifier: GPL-3.0-or-later
#include "ray_scene.hpp"

#include <limits>

#include "hyperex/geometry/embree_device.hpp"

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
  const RTCDevice device = embree_device();
  scene_ = rtcNewScene(device);
  rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
  const Eigen::Matrix3d camera_from_world = camera.axes();
  for (const Surface& surface : surfaces) {
    const auto vertices = static_cast<size_t>(surface.mesh.points.rows());
    const auto triangles = static_cast<size_t>(surface.mesh.triangles.rows());
    if (triangles == 0) continue;
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertices));
    auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned), triangles));
    for (size_t i = 0; i < vertices; ++i) {
      const Vec3 world = surface.mesh.points.row(i).transpose();
      Eigen::Map<Eigen::Vector3f>(v + 3 * i) =
          (camera_from_world * (world - camera.target)).cast<float>();
      if (v[3 * i + 2] > above_) above_ = v[3 * i + 2];
    }
    for (size_t i = 0; i < 3 * triangles; ++i)
      t[i] = static_cast<unsigned>(surface.mesh.triangles.data()[i]);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_, geometry, static_cast<unsigned>(&surface - surfaces.data()));
    rtcReleaseGeometry(geometry);
  }
  commit_whole(scene_);
  above_ *= 1.01f;
}

RayScene::~RayScene() {
  rtcReleaseScene(scene_);
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
