// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once
#include <embree3/rtcore.h>
#include <tbb/parallel_for.h>

#include <exception>
#include <new>
#include <stdexcept>

#include "hyperex/geometry/types.hpp"

namespace hyperex {

/// The Embree device of this process, shared by all scenes and threads. Creating a device takes as
/// long as a tree of some thousand triangles. Throws std::runtime_error if Embree cannot be
/// initialised.
inline RTCDevice embree_device() {
  static const RTCDevice device = rtcNewDevice(nullptr);
  if (!device) throw std::runtime_error("Embree does not start");
  return device;
}

/// Throws the error that Embree has reported in this thread, if any. Without this check, Embree
/// continues after running out of memory, and queries on the missing tree crash.
inline void throw_embree_error() {
  const RTCError error = rtcGetDeviceError(embree_device());
  if (error == RTC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
  if (error != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build its tree");
}

/// A scene that is released by the destructor, also if filling it fails.
class EmbreeScene {
 public:
  EmbreeScene() : scene_(rtcNewScene(embree_device())) {
    if (!scene_) throw_embree_error();
    if (!scene_) throw std::bad_alloc();
  }
  ~EmbreeScene() {
    if (scene_) rtcReleaseScene(scene_);
  }
  EmbreeScene(EmbreeScene&& other) noexcept : scene_(other.scene_) { other.scene_ = nullptr; }
  EmbreeScene& operator=(EmbreeScene&&) = delete;
  operator RTCScene() const { return scene_; }

 private:
  RTCScene scene_;
};

/// Adds a mesh to a scene for ray queries. Hits report it as `id`.
inline void add_triangles(RTCScene scene, const Points& points, const Triangles& triangles,
                          unsigned id) {
  const RTCGeometry geometry = rtcNewGeometry(embree_device(), RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* v = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0,
                                                        RTC_FORMAT_FLOAT3, 3 * sizeof(float),
                                                        std::size_t(points.rows())));
  auto* t = static_cast<unsigned*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0,
                                                           RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
                                                           std::size_t(triangles.rows())));
  if (!v || !t) {
    rtcReleaseGeometry(geometry);
    throw_embree_error();
    throw std::bad_alloc();
  }
  for (Eigen::Index i = 0; i < points.rows(); ++i)
    for (int k = 0; k < 3; ++k) v[3 * i + k] = float(points(i, k));
  for (Eigen::Index f = 0; f < triangles.rows(); ++f)
    for (int k = 0; k < 3; ++k) t[3 * f + k] = unsigned(triangles(f, k));
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  rtcReleaseGeometry(geometry);
}

/// The task group in which all trees are built. It is never cancelled, as nothing is thrown in it,
/// and never destroyed: the tasks of a scene refer to the group of its first build for as long as
/// the scene exists. TBB follows that reference when it cancels any other group.
inline tbb::task_group_context& tree_builds() {
  static auto* const group = new tbb::task_group_context(tbb::task_group_context::isolated);
  return *group;
}

/// Builds the tree of a scene. Embree distributes this work through TBB. If an exception has
/// cancelled the surrounding task group, the tree would be left incomplete, and queries would
/// crash. Therefore the build runs in another group. Throws std::bad_alloc if memory runs out.
inline void commit_whole(RTCScene scene) {
  std::exception_ptr error;
  tbb::parallel_for(
      0, 1,
      [&](int) {
        try {
          rtcCommitScene(scene);
          throw_embree_error();  // errors are reported in the thread that builds the tree
        } catch (...) {
          error = std::current_exception();
        }
      },
      tree_builds());
  if (error) std::rethrow_exception(error);
}

/// Whether a ray meets a triangle of a committed scene between two distances along it (unit
/// length).
inline bool meets(RTCScene scene, const Vec3& from, const Vec3& along, double near_m,
                  double far_m) {
  RTCRay ray{};
  ray.org_x = float(from.x()), ray.org_y = float(from.y()), ray.org_z = float(from.z());
  ray.dir_x = float(along.x()), ray.dir_y = float(along.y()), ray.dir_z = float(along.z());
  ray.tnear = float(near_m);
  ray.tfar = float(far_m);
  ray.mask = ~0u;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
  return ray.tfar < 0;
}

}  // namespace hyperex
