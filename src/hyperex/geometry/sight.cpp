// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/geometry/sight.hpp"

#include "hyperex/geometry/embree_device.hpp"
#include "hyperex/geometry/surface_topology.hpp"

namespace hyperex {
namespace {

constexpr double kOff_m = 1e-4;  // distance of a ray's start from the surface
// Hits closer to the start than this are on the vertex's own triangles.
constexpr float kFrom_m = 2e-4f;

class RayTree {
 public:
  explicit RayTree(const TriMesh& mesh) {
    rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
    add_triangles(scene_, mesh.points, mesh.triangles, 0);
    commit_whole(scene_);
  }

  bool blocked(const Vec3& from, const Vec3& towards, double reach_m) const {
    return meets(scene_, from, towards, kFrom_m, reach_m);
  }

 private:
  EmbreeScene scene_;
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
