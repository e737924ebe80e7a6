// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/anatomy/bones.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>

#include "hyperex/core/bounds.hpp"
#include "hyperex/geometry/closest_point.hpp"
#include "hyperex/geometry/embree_device.hpp"

namespace hyperex::anatomy {
namespace {

/// A surface and its tree; no tree where it is empty.
struct BoneSurface {
  explicit BoneSurface(TriMesh of) : mesh(std::move(of)) {
    if (mesh.triangles.rows() > 0) tree.emplace(mesh);
  }
  TriMesh mesh;
  std::optional<SurfaceTree> tree;
};

}  // namespace

struct Bones::Impl {
  Impl(TriMesh a, TriMesh b, std::optional<Condyles> c)
      : skull(std::move(a)), mandible(std::move(b)), condyles(c) {
    if (!skull.tree && !mandible.tree) throw std::invalid_argument("the bones have no triangles");
    unsigned id = 0;
    for (const TriMesh* mesh : {&skull.mesh, &mandible.mesh}) {
      if (mesh->triangles.rows() > 0) add_triangles(rays, mesh->points, mesh->triangles, id);
      ++id;
    }
    commit_whole(rays);
  }
  BoneSurface skull, mandible;
  std::optional<Condyles> condyles;
  EmbreeScene rays;
};

Bones::Bones(TriMesh skull, TriMesh mandible, std::optional<Condyles> condyles)
    : impl_(std::make_unique<const Impl>(std::move(skull), std::move(mandible), condyles)) {}
Bones::~Bones() = default;

const TriMesh& Bones::skull() const {
  return impl_->skull.mesh;
}
const TriMesh& Bones::mandible() const {
  return impl_->mandible.mesh;
}
const std::optional<Condyles>& Bones::condyles() const {
  return impl_->condyles;
}

Bones::Place Bones::nearest(Bone bone, const Vec3& p, double within_m) const {
  const BoneSurface& surface = bone == Bone::mandible ? impl_->mandible : impl_->skull;
  if (!surface.tree) return {};
  const ClosestPoint found = surface.tree->query(p, within_m);
  if (found.triangle < 0) return {};
  return {bone, found.point, std::sqrt(found.squared_distance)};
}

Bones::Place Bones::nearest(const Vec3& p, double within_m) const {
  const Place skull = nearest(Bone::skull, p, within_m);
  const Place jaw =
      nearest(Bone::mandible, p, skull.bone == Bone::none ? within_m : skull.distance_m);
  if (jaw.bone == Bone::none) return skull;
  return skull.bone == Bone::none || jaw.distance_m < skull.distance_m ? jaw : skull;
}

double Bones::along(const Vec3& from, const Vec3& way, double within_m) const {
  RTCRayHit ray{};
  ray.ray.org_x = float(from.x()), ray.ray.org_y = float(from.y()), ray.ray.org_z = float(from.z());
  ray.ray.dir_x = float(way.x()), ray.ray.dir_y = float(way.y()), ray.ray.dir_z = float(way.z());
  ray.ray.tfar = float(within_m);
  ray.ray.mask = ~0u;
  ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(impl_->rays, &context, &ray);
  return ray.hit.geomID == RTC_INVALID_GEOMETRY_ID ? std::numeric_limits<double>::infinity()
                                                   : double(ray.ray.tfar);
}

std::optional<Condyles> find_condyles(const TriMesh& mandible, const face::FaceFrame& frame,
                                      const Vec3& jaw_axis) {
  constexpr double kOffMiddle_m = 0.02, kHind_m = 0.02, kHead_m = 0.008, kFarthest_m = 0.045;
  constexpr Bounds kApart_m{0.07, 0.13};
  const Vec3 middle = frame.local(jaw_axis);
  const Points local = frame.local_points(mandible.points);
  Condyles out;
  for (const int side : {0, 1}) {
    const auto of_side = [&](const Vec3& p) {
      return (side == 0 ? 1 : -1) * (p.x() - middle.x()) > kOffMiddle_m;
    };
    double back = std::numeric_limits<double>::infinity();
    for (Eigen::Index v = 0; v < local.rows(); ++v)
      if (of_side(local.row(v))) back = std::min(back, local(v, 2));
    double top = -std::numeric_limits<double>::infinity();
    for (Eigen::Index v = 0; v < local.rows(); ++v)
      if (of_side(local.row(v)) && local(v, 2) < back + kHind_m) top = std::max(top, local(v, 1));
    if (!std::isfinite(top)) return std::nullopt;
    Vec3 sum = Vec3::Zero();
    int count = 0;
    for (Eigen::Index v = 0; v < local.rows(); ++v)
      if (of_side(local.row(v)) && local(v, 2) < back + kHind_m && local(v, 1) > top - kHead_m) {
        sum += local.row(v).transpose();
        ++count;
      }
    out[std::size_t(side)] = frame.world(sum / count);
  }
  if (!kApart_m.holds((out[0] - out[1]).norm()) ||
      (0.5 * (out[0] + out[1]) - jaw_axis).norm() > kFarthest_m)
    return std::nullopt;
  return out;
}

}  // namespace hyperex::anatomy
