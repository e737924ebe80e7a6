// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/closest_point.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "hyperex/geometry/embree_device.hpp"

namespace hyperex {
namespace {

constexpr double kSliver2 = 1e-8;  // (height / longest edge)^2 of triangles that are slivers
constexpr double kInside = 1e-9;   // a weight above it is not negative by rounding

// The closest point on the segment (a, b), as the fraction of the way from a to b.
double share_on_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
  const Vec3 edge = b - a;
  const double length2 = edge.squaredNorm();
  if (!(length2 > 0)) return 0;
  return std::clamp((p - a).dot(edge) / length2, 0.0, 1.0);
}

}  // namespace

ClosestPoint closest_point_on_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 corner[3] = {a, b, c};
  ClosestPoint best;
  best.squared_distance = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3& weights) {
    const Vec3 point = weights[0] * a + weights[1] * b + weights[2] * c;
    const double d2 = (p - point).squaredNorm();
    if (d2 < best.squared_distance) best = {0, point, weights, d2};
  };
  const Vec3 ab = b - a, ac = c - a, normal = ab.cross(ac);
  const double area2 = normal.squaredNorm();
  Vec3 foot = Vec3::Constant(-1);  // weights of the foot of the perpendicular
  if (area2 > 0) {
    foot[1] = (p - a).cross(ac).dot(normal) / area2;
    foot[2] = ab.cross(p - a).dot(normal) / area2;
    foot[0] = 1 - foot[1] - foot[2];
    if (foot.minCoeff() >= 0) offer(foot);
  }
  // The closest point lies on an edge only if the foot lies beyond that edge, where the weight of
  // the opposite corner is negative. In a sliver rounding decides on which side the foot lies.
  const double longest2 = std::max({ab.squaredNorm(), ac.squaredNorm(), (c - b).squaredNorm()});
  const bool sliver = !(area2 > kSliver2 * longest2 * longest2);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3;
    if (!sliver && foot[(k + 2) % 3] > kInside) continue;
    const double share = share_on_segment(p, corner[k], corner[next]);
    Vec3 weights = Vec3::Zero();
    weights[k] = 1 - share;
    weights[next] = share;
    offer(weights);
  }
  return best;
}

struct SurfaceTree::Impl {
  TriMesh mesh;
  // The tree is built relative to this point, to lose fewer digits in single precision.
  Vec3 centre = Vec3::Zero();
  double slack = 0;  // upper bound of the rounding error of a bound
  RTCScene scene = nullptr;

  ~Impl() {
    if (scene) rtcReleaseScene(scene);
  }

  Vec3 corner(int triangle, int k) const {
    return mesh.points.row(mesh.triangles(triangle, k)).transpose();
  }

  static void bounds(const RTCBoundsFunctionArguments* args) {
    const auto& self = *static_cast<const Impl*>(args->geometryUserPtr);
    float low[3], high[3];
    for (int axis = 0; axis < 3; ++axis) {
      const auto coordinate = [&](int k) {
        const int vertex = self.mesh.triangles(static_cast<int>(args->primID), k);
        return self.mesh.points(vertex, axis) - self.centre[axis];
      };
      const auto [least, most] = std::minmax({coordinate(0), coordinate(1), coordinate(2)});
      low[axis] = static_cast<float>(least - self.slack);
      high[axis] = static_cast<float>(most + self.slack);
    }
    *args->bounds_o = {low[0], low[1], low[2], 0, high[0], high[1], high[2], 0};
  }

  struct Search {
    const Impl* self;
    Vec3 p;
    ClosestPoint best;
    const char* keep;  // null: all
  };

  static bool visit(RTCPointQueryFunctionArguments* args) {
    auto& search = *static_cast<Search*>(args->userPtr);
    const int triangle = static_cast<int>(args->primID);
    if (search.keep && !search.keep[triangle]) return false;
    ClosestPoint found = closest_point_on_triangle(search.p, search.self->corner(triangle, 0),
                                                   search.self->corner(triangle, 1),
                                                   search.self->corner(triangle, 2));
    found.triangle = triangle;
    const ClosestPoint& best = search.best;
    if (found.squared_distance > best.squared_distance) return false;
    if (found.squared_distance == best.squared_distance && best.triangle >= 0 &&
        triangle > best.triangle)
      return false;
    search.best = found;
    // The radius is a little greater than the best distance, so that every triangle at that
    // distance is visited.
    const double radius = std::sqrt(found.squared_distance) * (1 + 1e-5) + search.self->slack;
    args->query->radius = static_cast<float>(radius);
    return true;
  }

  ClosestPoint query(const Vec3& p, double within, const char* keep) const {
    Search search{this, p, {}, keep};
    search.best.squared_distance = within * within;
    const Eigen::Vector3f about = (p - centre).cast<float>();
    const auto reach = static_cast<float>(within * (1 + 1e-5) + slack);
    RTCPointQuery query{about[0], about[1], about[2], 0, reach};
    RTCPointQueryContext context;
    rtcInitPointQueryContext(&context);
    rtcPointQuery(scene, &query, &context, nullptr, &search);
    return search.best;
  }
};

namespace {

constexpr Eigen::Index kFewTriangles = 5000;

void check_mesh(const TriMesh& mesh) {
  if (mesh.triangles.rows() == 0) throw std::invalid_argument("closest point: no triangles");
  if (!mesh.points.allFinite()) throw std::invalid_argument("closest point: a point is not finite");
  if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.points.rows())
    throw std::invalid_argument("closest point: a triangle's index is out of range");
}

}  // namespace

SurfaceTree::SurfaceTree(const TriMesh& mesh) : impl_(std::make_unique<Impl>()) {
  check_mesh(mesh);
  impl_->mesh = mesh;
  const Vec3 low = mesh.points.colwise().minCoeff(), high = mesh.points.colwise().maxCoeff();
  impl_->centre = (low + high) / 2;
  impl_->slack = 1e-6 * std::max((high - low).norm(), 1e-12);
  const RTCDevice device = embree_device();
  impl_->scene = rtcNewScene(device);
  if (!impl_->scene) throw std::bad_alloc();
  rtcSetSceneFlags(impl_->scene, RTC_SCENE_FLAG_ROBUST);
  // Meshes with few triangles usually get few queries. For them, a tree that is built fast is
  // better than a tree with fast queries.
  if (mesh.triangles.rows() < kFewTriangles)
    rtcSetSceneBuildQuality(impl_->scene, RTC_BUILD_QUALITY_LOW);
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(mesh.triangles.rows()));
  rtcSetGeometryUserData(geometry, impl_.get());
  rtcSetGeometryBoundsFunction(geometry, &Impl::bounds, nullptr);
  rtcSetGeometryPointQueryFunction(geometry, &Impl::visit);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(impl_->scene, geometry);
  rtcReleaseGeometry(geometry);
  commit_whole(impl_->scene);
}
SurfaceTree::~SurfaceTree() = default;
SurfaceTree::SurfaceTree(SurfaceTree&&) noexcept = default;
SurfaceTree& SurfaceTree::operator=(SurfaceTree&&) noexcept = default;

ClosestPoint SurfaceTree::query(const Vec3& p, double within) const {
  return impl_->query(p, within, nullptr);
}

ClosestPoint SurfaceTree::query_among(const std::vector<char>& keep, const Vec3& p,
                                      double within) const {
  if (keep.size() != std::size_t(impl_->mesh.triangles.rows()))
    throw std::invalid_argument("closest point: one entry a triangle is needed");
  return impl_->query(p, within, keep.data());
}

double SurfaceTree::reach(const Vec3& p, const Vec3& near) const {
  // Wider than the rounding errors of the point and of its distance, so that the triangle
  // containing `near` is visited.
  return (p - near).norm() * (1 + 1e-9) + impl_->slack;
}

std::vector<ClosestPoint> SurfaceTree::query_all(const Points& points,
                                                 const std::vector<ClosestPoint>& near) const {
  if (near.size() != std::size_t(points.rows())) return query_all(points);
  std::vector<ClosestPoint> found(near.size());
  tbb::parallel_for(Eigen::Index{0}, points.rows(), [&](Eigen::Index row) {
    const Vec3 p = points.row(row).transpose();
    found[std::size_t(row)] = query(p, reach(p, near[std::size_t(row)].point));
  });
  return found;
}

std::vector<ClosestPoint> SurfaceTree::query_all(const Points& points) const {
  std::vector<ClosestPoint> found(points.rows());
  tbb::parallel_for(Eigen::Index{0}, points.rows(), [&](Eigen::Index row) {
    found[row] = query(Vec3(points.row(row).transpose()));
  });
  return found;
}

}  // namespace hyperex
