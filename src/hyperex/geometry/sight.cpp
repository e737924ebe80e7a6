// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/sight.hpp"

#include "hyperex/geometry/embree_device.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

constexpr double kOff_m = 1e-4;   // of the surface, where a ray begins
constexpr float kFrom_m = 2e-4f;  // of its beginning: nearer hits are the vertex's own triangles

class RayTree {
 public:
  explicit RayTree(const TriMesh& mesh) : scene_(rtcNewScene(embree_device())) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    const RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                          RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                          std::size_t(mesh.points.rows())));
    auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                             RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                             std::size_t(mesh.triangles.rows())));
    for (Eigen::Index i = 0; i < mesh.points.rows(); ++i)
      for (int k = 0; k < 3; ++k) v[3 * i + k] = float(mesh.points(i, k));
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f)
      for (int k = 0; k < 3; ++k) t[3 * f + k] = unsigned(mesh.triangles(f, k));
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene_, geometry);
    rtcReleaseGeometry(geometry);
    commit_whole(scene_);
  }
  ~RayTree() { rtcReleaseScene(scene_); }
  RayTree(const RayTree&) = delete;
  RayTree& operator=(const RayTree&) = delete;

  bool blocked(const Vec3& from, const Vec3& towards, double reach_m) const {
    RTCRay ray{};
    ray.org_x = float(from.x()), ray.org_y = float(from.y()), ray.org_z = float(from.z());
    ray.dir_x = float(towards.x()), ray.dir_y = float(towards.y()), ray.dir_z = float(towards.z());
    ray.tnear = kFrom_m;
    ray.tfar = float(reach_m);
    ray.mask = ~0u;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(scene_, &context, &ray);
    return ray.tfar < 0;
  }

 private:
  RTCScene scene_;
};

}  // namespace

std::vector<double> blocked_shares(const TriMesh& mesh, const std::vector<int>& vertices,
                                   const Points& directions, double reach_m) {
  const RayTree tree(mesh);
  const Points normals = vertex_normals(mesh);
  std::vector<double> share(vertices.size());
  tbb::parallel_for(std::size_t(0), vertices.size(), [&](std::size_t i) {
    const Vec3 from = mesh.points.row(vertices[i]) + kOff_m * normals.row(vertices[i]);
    Eigen::Index blocked = 0;
    for (Eigen::Index d = 0; d < directions.rows(); ++d)
      blocked += tree.blocked(from, directions.row(d), reach_m);
    share[i] = double(blocked) / double(directions.rows());
  });
  return share;
}

}  // namespace hyperex
