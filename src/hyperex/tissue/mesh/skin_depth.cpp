// SPDX-License-Identifier: GPL-3.0-or-later
#include "hyperex/tissue/mesh/skin_depth.hpp"

#include "hyperex/tissue/mesh/on_skin.hpp"
#include "hyperex/tissue/per_vertex/per_vertex.hpp"

namespace hyperex::tissue {

bool is_painted(const TissueMeshOptions& options) {
  return !options.depth_per_vertex.empty() || !options.depth_regions.empty();
}

std::vector<Note> notes_on_depth_files(const TissueMeshOptions& options, const TriMesh& scan) {
  std::vector<Note> notes;
  if (!options.depth_per_vertex.empty()) read_depths(options.depth_per_vertex, scan, notes);
  for (const DepthRegion& region : options.depth_regions) read_paint(region.painted, scan, notes);
  return notes;
}

Eigen::VectorXd unpainted_depth(const Points& points, const io::Landmarks& landmarks,
                                const TissueMeshOptions& options) {
  if (options.thickness_m > 0) return Eigen::VectorXd::Constant(points.rows(), options.thickness_m);
  std::vector<DepthAt> depths = published_depths();
  for (const DepthAt& own : options.depths) {
    std::erase_if(depths, [&](const DepthAt& d) { return d.landmark == own.landmark; });
    depths.push_back(own);
  }
  return depth_field(points, depths, landmarks);
}

Eigen::VectorXd skin_depth(const TissueMesh& mesh, const io::Landmarks& landmarks,
                           const TissueMeshOptions& options) {
  if (mesh.full) {
    TissueMesh whole = with_full_skin(mesh);
    whole.full = nullptr;
    return skin_depth(whole, landmarks, options)(mesh.full->kept);
  }
  Eigen::VectorXd depth = unpainted_depth(mesh.skin.points, landmarks, options);
  const TriMesh scan = scan_of(mesh);
  std::vector<Note> noted;  // when the inputs were read
  if (!options.depth_per_vertex.empty()) {
    const Eigen::VectorXd own = on_skin(mesh, read_depths(options.depth_per_vertex, scan, noted));
    depth = own.array().isNaN().select(depth, own).eval();
  }
  for (const DepthRegion& region : options.depth_regions) {
    const Eigen::VectorXd share = on_skin(mesh, read_paint(region.painted, scan, noted));
    depth.array() += share.array() * (region.depth_m - depth.array());
  }
  return depth;
}

}  // namespace hyperex::tissue
